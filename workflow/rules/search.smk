# A search for better designs, in rounds: each proposes some by what all before them gave, until the budget is spent. A design's
# models and runs are made by the rules of the structure and the sweep, as members of samples are.
from r37core.search.plan import BUILT, DATASET, DESIGN_NAME, MEASURES, SHAPE, TABLE, BEST, Search, choice_of
from r37core.search.plan import ROUND as SEARCH_ROUND

search = Search(
    sweep,
    lambda number: checkpoints.search_round.get(round=number).output[0],
    lambda number: checkpoints.search_built.get(round=number).output[0],
)


wildcard_constraints:
    design=DESIGN_NAME,


checkpoint search_round:
    input:
        unpack(search.round_inputs),
    output:
        round=SEARCH_ROUND,
    log:
        "<logs>/search/round_{round}.log",
    wildcard_constraints:
        round=r"\d+",
    priority: 4
    conda:
        ENVIRONMENT
    params:
        **step("search.steps.propose_round"),
        choice=search.choice,
        round=lambda wildcards: int(wildcards.round),
        number=search.number_of_designs,
    script:
        "../scripts/step.py"


# a design that cannot be built is a result, so it is tried before its model is planned
use rule step as search_shape with:
    output:
        shape=SHAPE,
    log:
        "<logs>/search/{design}/shape.log",
    priority: 3
    params:
        **step("search.steps.shape"),
        shape=search.shape,
        edges=settings.structure.edges,
        mesh=plain(settings.fidelity.mesh),
        stress_region=lambda wildcards: to_plain(settings.reduction_choice(search.designs.entry.blade).judged_region),


checkpoint search_built:
    input:
        shapes=search.shapes,
    output:
        built=BUILT,
    log:
        "<logs>/search/built_{round}.log",
    wildcard_constraints:
        round=r"\d+",
    priority: 4
    conda:
        ENVIRONMENT
    params:
        **step("search.steps.built"),
    script:
        "../scripts/step.py"


use rule step as search_measures with:
    input:
        unpack(search.measured),
    output:
        measures=MEASURES,
    log:
        "<logs>/search/{design}/measures.log",
    priority: 5
    params:
        **step("search.steps.measure"),
        quantities=lambda wildcards: to_plain(choice_of(settings).quantities),
        scenes=search.responses_of_scenes,
        density=search.density,
        highest_speed=settings.structure.maximum_speed_rad_s,
        operating=operating,


use rule step as search_dataset with:
    input:
        round=search.last_round,
    output:
        dataset=DATASET,
        table=shown(TABLE, PACKAGE / "search/report.rst", "Search", "designs of the search"),
    log:
        "<logs>/search_dataset.log",
    params:
        **step("search.steps.join"),
        choice=search.choice,
        # another number of rounds, whose files may all be there
        budget=search.budget,
        fidelity=settings.fidelity_name,


use rule step as search_best with:
    input:
        dataset=rules.search_dataset.output.dataset,
        shapes=search.shapes_of_all,
    output:
        folder=directory(BEST),
    log:
        "<logs>/search_best.log",
    params:
        **step("search.steps.best"),
        entries=search.entries,
        scenes=search.scene_entries,
        varied_in_scenes=search.varied_in_scenes,
        number=lambda wildcards: search.designs.entry.best,
