# Single runs next to the sweep, and their tables. Not part of all_blades: snakemake tradeoff, stability or estimate
from r37core.product.extensions import whole_extent
from r37studies.other_models import MODEL_FILES, MODEL_NAME
from r37studies.trials.plan import PRESETS, RESPONSE, TABLE, Trials

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
        **{**stages["mesh"].params, **stages["reduced_model"].params, "kept": False},
        **step("r37studies.trials.steps.model"),
        choice=trials.reduction,


use rule step as trials_table with:
    input:
        cases=trials.files,
    output:
        table=TABLE,
    log:
        "<logs>/{preset}.log",
    wildcard_constraints:
        preset="|".join(PRESETS),
    params:
        **step("r37studies.trials.steps.report", *(preset.TABLE.rpartition(".")[0] for preset in PRESETS.values())),
        reasons=trials.reasons,
        table=lambda wildcards: PRESETS[wildcards.preset].TABLE,
        values=lambda wildcards: PRESETS[wildcards.preset].values(settings, whole_extent(settings)),
