% The container that NLstep asks for its model in: matrices of a massless-boundary model, and its contact elements.
% The class of this name in NLvib also makes such a model of a finite-element one; here Python does.
classdef CMS_ROM
    properties
        M, D, K, nb, nonlinear_elements
    end
    methods
        function yes = isMasslessBoundaryROM(model)
            yes = ~any(any(model.M(1:model.nb, :)));
        end
    end
end
