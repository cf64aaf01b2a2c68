# Single runs next to the sweep, and their tables. Not part of all_blades: snakemake tradeoff, stability or estimate
from r37core.product.extensions import simulations_of_members
from r37studies.other_models import MODEL_FILES, MODEL_NAME
from r37studies.trials.plan import PRESETS, RESPONSE, Trials

trials = Trials(settings)


use rule step as trial with:
    input:
        unpack(trials.inputs),
    output:
        response=RESPONSE,
    log:
        "<logs>/{preset}/{case}.log",
    wildcard_constraints:
        preset="|".join(PRESETS),
        case=r"[\w.+/-]+",
    params:
        **step("r37studies.trials.steps.run"),
        case=lambda wildcards: to_plain(trials.case(wildcards)),


use rule step as trial_model with:
    input:
        unpack(trials.shape),
    output:
        **MODEL_FILES,
    log:
        "<logs>/cases/{blade}/{model}/model.log",
    wildcard_constraints:
        model=MODEL_NAME,
    priority: 2
    params:
        **step("r37studies.trials.steps.model"),
        choice=trials.reduction,
        material=sweep.material,
        provenance=sweep.structure_provenance,


for name, preset in PRESETS.items():

    # a variant of `step` cannot be named by a variable
    rule:
        name:
            f"{name}_tables"
        input:
            cases=partial(trials.files, name),
        output:
            **preset.TABLES,
        log:
            f"<logs>/{name}_tables.log",
        conda:
            ENVIRONMENT
        resources:
            mem_mb=500,
        params:
            **step("r37studies.trials.steps.report", f"r37studies.trials.{name}_tables"),
            module=f"r37studies.trials.{name}_tables",
            reasons=partial(trials.reasons, name),
            values=lambda wildcards, preset=preset: preset.values(settings, simulations_of_members(settings)),
        script:
            str(SCRIPTS / "step.py")
