% Direct contact with an installed NLstep: run_nlstep(folder of NLstep, file of the case, file of the results).
% SI units. A case: see massless_boundary.py.
function run_nlstep(program, case_file, result_file)
    addpath(fileparts(mfilename('fullpath')));
    addpath(fullfile(program, 'SRC'));
    scene = load(case_file);
    model = CMS_ROM;
    model.M = scene.M;
    model.D = scene.D;
    model.K = scene.K;
    model.nb = 3 * numel(scene.theta);
    model.nonlinear_elements = cell(numel(scene.theta), 1);
    for node = 1:numel(scene.theta)
        model.nonlinear_elements{node} = struct( ...
            'type', '3D', ...
            'imposedGap', @(t) gap(scene, scene.theta(node), t), ...
            'imposedGapVelocity', @(t) gap_velocity(scene, scene.theta(node), scene.radius(node), t), ...
            'frictionCoefficient', scene.friction);
    end
    rest = zeros(size(scene.K, 1), 1);
    % the first step from rest ends at t = step, so that a sample is what is stored
    times = (1:scene.steps) * scene.step;
    options = struct('dataStorageFrequency', scene.steps_per_sample, 'verbosity', 0);
    [coordinates, ~, ~, ~, info] = sim_contact3D(times, rest, rest, model, options);
    not_converged = sum(~info.IEx);
    save('-v7', result_file, 'coordinates', 'not_converged');
end

function distance = gap(scene, theta, t)
    [risen, ~] = rise(scene, t);
    distance = scene.clearance - scene.height * risen .* lobe(scene, theta, t);
end

function velocity = gap_velocity(scene, theta, radius, t)
    [risen, rising] = rise(scene, t);
    [shape, from_top] = lobe(scene, theta, t);
    changing = shape .* 2 .* from_top / scene.width^2 * scene.speed / scene.period;
    normal = -scene.height * (risen .* changing + rising .* shape);
    velocity = [normal; -radius * scene.speed * ones(size(t)); zeros(size(t))];
end

function [shape, from_top] = lobe(scene, theta, t)
    from_top = mod(theta - scene.speed * t, scene.period) / scene.period - 0.5;
    shape = exp(-(from_top / scene.width).^2);
end

function [risen, rising] = rise(scene, t)
    if isinf(scene.rise_rate)
        risen = ones(size(t));
        rising = zeros(size(t));
    else
        risen = 1 - exp(-scene.rise_rate * t);
        rising = scene.rise_rate * exp(-scene.rise_rate * t);
    end
end
