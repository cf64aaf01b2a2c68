"""Pictures of pages that are figures of a run, and the worked example of docs/your_blade.md, drawn as the page says."""

from evidence.plan import Item, table

from plan.runs import ALL_SPEEDS, MAIN

FIGURES = {
    "interactions": f"{ALL_SPEEDS.folder}/figures/interactions.png",
    "which_blade_Ref": f"{ALL_SPEEDS.folder}/figures/response_Ref.png",
    "blades": f"{MAIN.folder}/figures/blades.png",
    "response_Ref": f"{MAIN.folder}/figures/response_Ref.png",
}
"""Picture of a page -> the figure that it is."""

EVIDENCE = [
    *(Item("evidence.pictures.of_run", {"picture": f"docs/{name}.png"}, {"figure": file}) for name, file in FIGURES.items()),
    Item(
        "evidence.user_code.worked_example",
        {"campbell": "docs/your_blade_campbell.png", "response": "docs/your_blade_response.png"},
        params={"page": "docs/your_blade.md"},
        alone=True,
    ),
    Item(
        "evidence.tutorial.write",
        {"notebook": "docs/tutorial.ipynb"},
        params={"program": "docs/tutorial.py"},
        sources=["docs/tutorial.py"],
        alone=True,
    ),
    # of the product's code alone: a test says whether it is fresh
    Item("evidence.key_tables.columns", {"table": table("columns")}),
]
