# The studies `tradeoff`, what accuracy costs, and `growth`, how cost grows.
from r37core.studies.tradeoff_plan import Tradeoff

tradeoff = Tradeoff(settings)


rule tradeoff_case:
    input:
        unpack(tradeoff.model),
        campbell=paths.CAMPBELL,
    output:
        paths.TRADEOFF_CASE,
    log:
        "<logs>/studies/tradeoff/{blade}/{parameter}/{value}.log",
    wildcard_constraints:
        parameter="|".join(tradeoff.values),
        value=r"[\w.+-]+",
    conda:
        ENVIRONMENT
    params:
        scenes=tradeoff.scenes,
        described=tradeoff.described,
        choices=tradeoff.choices,
        places=tradeoff.places,
        engine_order=tradeoff.engine_order,
        material=study_models.material,
        code=code("tradeoff_case"),
    script:
        "../../scripts/tradeoff_case.py"


rule tradeoff:
    input:
        tradeoff.cases,
    output:
        dataset="<results>/studies/tradeoff.nc",
        levels="<results>/studies/levels.md",
        table="<results>/studies/tradeoff.md",
        parameters=expand("<results>/studies/figures/tradeoff_{parameter}.png", parameter=tradeoff.values),
        pareto="<results>/studies/figures/tradeoff_pareto.png",
    log:
        "<logs>/studies/tradeoff.log",
    conda:
        ENVIRONMENT
    params:
        parameters=list(tradeoff.values),
        references=tradeoff.references,
        tolerance=settings.config.tolerance,
        provenance=tradeoff.provenance,
        code=code("tradeoff"),
    script:
        "../../scripts/tradeoff.py"


rule growth:
    input:
        "<results>/studies/tradeoff.nc",
    output:
        table="<results>/studies/growth.md",
        figure="<results>/studies/figures/growth.png",
    log:
        "<logs>/studies/growth.log",
    conda:
        ENVIRONMENT
    params:
        code=code("growth"),
    script:
        "../../scripts/growth.py"
