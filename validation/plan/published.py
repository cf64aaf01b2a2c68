"""What the paper publishes, next to ours (docs/validation.md), and our counterpart of its figures (docs/gallery.md)."""

from evidence import published_windows as windows
from evidence.plan import Item, Run, table
from published import BLADES, REFERENCE

SCENES = {"scenes_file": "validation/published.yaml"}
PUBLISHED = Run("published", keys={**SCENES, "scenes": "all", **windows.standard_speeds()})
PAPER = Run("paper", keys={**SCENES, "scenes": [windows.LINED, windows.DIRECT], "fidelity": "paper", **windows.paper_speeds()})

FOLDER = f"{PUBLISHED.folder}/{REFERENCE}"
STANDARD = {
    "standard": windows.responses(PUBLISHED.folder),
    "models": [f"{PUBLISHED.folder}/{blade}/rom_pressure_edge.nc" for blade in BLADES],
}
CHOICES = {name: windows.choice_responses(PUBLISHED.folder, name) for name in windows.CHOICES}
CHARTS = ("campbell", "reference", "spectrum_lined", "stress", "wear_content")

EVIDENCE = [
    Item(
        "evidence.published_tables.checks",
        {name: table(name) for name in ("validation_checks", "validation_differences", "published_summary")},
        {
            **STANDARD,
            "paper": windows.responses(PAPER.folder),
            "campbells": [f"{PUBLISHED.folder}/{blade}/campbell.nc" for blade in BLADES],
            "geometry": f"{FOLDER}/geometry.nc",
        },
        sources=["validation/published.py"],
    ),
    Item("evidence.published_tables.choices", {"table": table("modelling_choices")}, {**STANDARD, **CHOICES}),
    Item(
        "evidence.constants.table",
        {"table": table("benchmark_constants")},
        sources=["config/blades.yaml", "config/scenes.yaml", "config/fidelity.yaml"],
    ),
    Item(
        "evidence.gallery.charts",
        {name: f"docs/gallery/{name}.png" for name in CHARTS},
        {
            "lined": f"{FOLDER}/abradable/response.nc",
            "direct": f"{FOLDER}/direct/response.nc",
            "campbell": f"{FOLDER}/campbell.nc",
        },
    ),
    *(
        Item(
            "evidence.user_code.picture",
            {"picture": f"docs/user_code/{name}.png"},
            params={"program": f"examples/figures/{name}.py"},
            sources=[f"examples/figures/{name}.py"],
            alone=True,
        )
        for name in ("02_response", "03_two_blades", "09_tolerances")
    ),
]
