# A search for better designs, in rounds: each proposes some by what all before them gave, until the budget is spent.
from r37studies.search import plan as search_plan
from r37studies.search.plan import DATASET, TABLE, Search

search = Search(settings)


# on the cores that are free; designs that are done are there when it is started again
use rule step as search_designs with:
    output:
        dataset=DATASET,
        table=shown(TABLE, SOURCE / "r37studies/search/report.rst", "Search", "designs of the search"),
    log:
        "<logs>/search.log",
    priority: 3
    threads: lambda wildcards: sum(int(runs.number) for runs in search_plan.simulations(settings).values())
    resources:
        mem_mb=lambda wildcards, threads: (memory_of_model + 300) * threads,
    params:
        **step("r37studies.search.steps.search"),
        carried=search.carried,
        made_of=search.made_of,
        # the job makes structures of its own
        structure=lambda wildcards: [step(made.step, *made.modules) for made in stages.values()],
        budget=search.budget,
        fidelity=settings.fidelity_name,
