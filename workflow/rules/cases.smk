# Cases: runs of one blade beside the sweep, each with a model, scene or time integration of its own (r37core.cases).
from r37core.cases.case import MODEL_NAME
from r37core.cases.plan import MODEL_FILES, Cases, choice_of_model, shape_of_model
from r37core.product.extensions import EXTENSIONS

cases = {each.name: Cases(settings, each.name, each.cases) for each in EXTENSIONS if each.cases}

for extension, planned in cases.items():

    # a variant of `step` cannot be named by a variable
    rule:
        name:
            f"{extension}_case"
        input:
            unpack(planned.inputs),
        output:
            response=planned.file,
        log:
            planned.log,
        wildcard_constraints:
            case=r"[\w.+/-]+",
        conda:
            ENVIRONMENT
        resources:
            mem_mb=500,
        params:
            **step("cases.steps.run"),
            case=planned.case,
        script:
            "../scripts/step.py"


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
