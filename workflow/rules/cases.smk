# Models of cases: runs of one blade beside the sweep, each with a model, scene or time integration of its own (r37core.cases). The
# cases themselves are rules of the extensions that plan them.
from r37core.cases.case import MODEL_NAME
from r37core.cases.plan import MODEL_FILES, Cases, choice_of_model, shape_of_model


# the pattern of the extensions' cases, never run by itself
use rule step as case with:
    wildcard_constraints:
        case=r"[\w.+/-]+",
    params:
        **step("cases.steps.run"),


use rule step as case_model with:
    input:
        unpack(shape_of_model),
    output:
        **MODEL_FILES,
    log:
        "<logs>/cases/{blade}/{model}/model.log",
    wildcard_constraints:
        model=MODEL_NAME,
    priority: 2
    params:
        **step("cases.steps.model"),
        choice=choice_of_model,
        reduction=structure.reduction,
        material=structure.material,
        provenance=made.structure,
