# Studies of the model itself; none is part of all_blades. A study is a folder of r37core.studies: what runs, and what is said.
from r37core.studies.case import MODEL_NAME
from r37core.studies.plan import STUDIES, Studies

studies = Studies(settings)


rule study_model:
    input:
        paths.nominal(paths.GEOMETRY),
    output:
        rom=paths.STUDY_MODEL.replace("{file}", "rom.nc"),
        contact=paths.STUDY_MODEL.replace("{file}", "contact.npz"),
        cost=paths.STUDY_MODEL.replace("{file}", "cost.json"),
    log:
        paths.STUDY_MODEL.replace("{file}", "model.log").replace("<results>", "<logs>"),
    wildcard_constraints:
        model=MODEL_NAME,
    priority: 2
    conda:
        ENVIRONMENT
    params:
        choice=studies.model,
        reduction=structure.base_reduction,
        material=studies.material,
        provenance=made.structure,
        code=code("study_model"),
    script:
        "../scripts/study_model.py"


use rule campbell_of_blade as study_campbell with:
    input:
        paths.STUDY_MODEL.replace("{file}", "rom.nc"),
    output:
        paths.STUDY_MODEL.replace("{file}", "campbell.nc"),
    log:
        paths.STUDY_MODEL.replace("{file}", "campbell.log").replace("<results>", "<logs>"),
    wildcard_constraints:
        model=MODEL_NAME,


rule study_case:
    input:
        unpack(studies.case_inputs),
    output:
        paths.STUDY_CASE,
    log:
        paths.STUDY_CASE.replace("<results>", "<logs>").replace(".nc", ".log"),
    wildcard_constraints:
        study="|".join(STUDIES),
        case=r"[\w.+/-]+",
    conda:
        ENVIRONMENT
    params:
        case=studies.case,
        code=code("study_case"),
    script:
        "../scripts/study_case.py"


for study in STUDIES:

    rule:
        name:
            study
        input:
            unpack(studies.inputs(study)),
        output:
            **studies.outputs(study),
        log:
            f"<logs>/studies/{study}.log",
        conda:
            ENVIRONMENT
        params:
            study=study,
            cases=studies.names(study),
            values=studies.values(study),
            code=code("study", f"r37core.studies.{study}.report"),
        script:
            "../scripts/study.py"
