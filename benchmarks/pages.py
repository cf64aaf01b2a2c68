"""Puts the tables and pictures of the studies into the pages of docs/. Run: make docs (after that, read the difference).

A page says where with <!-- name --> ... <!-- end -->. Long tables have pages of their own; what they say stands before them.
"""

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from r37core.text_file import with_part

ROOT = Path(__file__).parent.parent
STUDIES = ROOT / "results" / "studies"
TABLES = {
    "accuracy": {
        "levels": "levels.md",
        "growth": "growth.md",
        "run_ups": "run_up_accuracy.md",
        "contact": "contact_accuracy_summary.md",
        **{
            f"patches_{name}": f"contact_patches_{name}.md"
            for name in ("convergence", "worst", "levels", "published", "blades", "statements", "layers", "stiffness", "peaks")
        },
    },
    "accuracy_tables": {
        "contact": "contact_accuracy.md",
        "meshes": "contact_meshes.md",
        "extremes": "contact_extremes.md",
        "branches": "contact_patches_branches.md",
        "refinement": "refinement.md",
        "tradeoff": "tradeoff.md",
    },
    "coriolis": {name: f"coriolis_{name}.md" for name in ("frequencies", "peaks", "direct", "cost")},
    "elastic_casing": {
        name: f"elastic_casing_{name}.md"
        for name in (
            "rings",
            "flexibility",
            "peaks",
            "direct",
            "diameters",
            "coincidences",
            "causes",
            "growth",
            "overtaken",
            "cost",
        )
    },
    "run_ups": {name: f"{name}.md" for name in ("run_up_rates", "run_up_variants", "run_up_cost")},
    "clearance": {"clearance_growth": "clearance_growth.md", "clearance_effect": "clearance_effect.md"},
    "tolerances": {f"tolerance_{name}": f"tolerance_{name}.md" for name in ("ranges", "sensitivity", "rankings", "members")},
    "stability_tables": {"stability": "stability.md"},
    "validation": {
        "modelling_choices": "modelling_choices.md",
        **{f"other_{name}": f"other_programs_{name}.md" for name in ("elastic", "worn", "direct", "histories", "rms")},
    },
    "validation_tables": {"validation": "validation.md", "ranges": "validation_ranges.md"},
    "speed": {"estimate": "estimate.md", "march_cost": "march_cost.md"},
}
SUMMARIES = {
    "stability": {"stability": "stability.md"},
    "validation": {"validation": "validation.md", "ranges": "validation_ranges.md"},
}
"""What stands on a page itself of a long table, which has a page of its own."""

PICTURES = (
    "contact_patches",
    "tradeoff_pareto",
    "growth",
    "coriolis_peaks",
    "elastic_casing_peaks",
    "modelling_choices",
    *(f"validation_{name}" for name in ("reference", "blades", "stress", "histories", "spectrum_lined", "spectrum_direct")),
)

ELASTIC = ROOT / "results/runs/elastic_casing"
"""The run of config/elastic_casing.yaml: pictures of other configurations have the same names, and show other things."""

FIGURES = {
    "response_Ref": ROOT / "results/figures/response_Ref.png",
    "clearance_growing_abradable": ROOT / "results/figures/clearance_growing_abradable.png",
    "casing_Ref": ELASTIC / "figures/casing_Ref__elastic_abradable.png",
    "campbell_elastic_casing": ELASTIC / "figures/campbell_Ref.png",
    "run_up_rates": ROOT / "results/figures/run_up_rates_abradable.png",
    "tolerances_Ref": ROOT / "results/runs/members/figures/tolerances_Ref__abradable.png",
    "run_ups_Ref": ROOT / "results/figures/run_ups_Ref__abradable.png",
}


def fill(page, name, text):
    """Replace what stands between the page's markers of this name."""
    page.write_text(with_part(page.read_text(encoding="utf-8"), name, text), encoding="utf-8")


def summary(text):
    """What stands before the first table, and the rows of that with something bold in them: what differs."""
    before, _, table = text.partition("\n|")
    header, line, *rows = f"|{table}".splitlines()
    bold = [row for row in rows if row.startswith("|") and "**" in row]
    return "\n".join([before.strip(), *(["", header, line, *bold] if bold else [])])


def rule_graph():
    """The rules of the main job as a Mermaid diagram, without their way to the final target.

    Drawn where there are no results: edges of rounds that are done are not drawn.
    """
    command = [str(Path(sys.executable).with_name("snakemake")), "all_blades", "--rulegraph", "mermaid-js"]
    with tempfile.TemporaryDirectory() as empty:
        command += ["--directory", empty]
        text = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    names = dict(re.findall(r"(id\d+)\[(\w+)\]", text))
    edges = sorted((names[one], names[other]) for one, other in re.findall(r"(id\d+) --> (id\d+)", text))
    lines = [f"    {one} --> {other}" for one, other in edges if other != "all_blades"]
    return "\n".join(["```mermaid", "flowchart LR", *lines, "```"])


def main():
    fill(ROOT / "docs" / "architecture.md", "rules", rule_graph())
    for parts, made in ((TABLES, str), (SUMMARIES, summary)):
        for page, tables in parts.items():
            for name, file in tables.items():
                if (STUDIES / file).exists():
                    fill(ROOT / "docs" / f"{page}.md", name, made((STUDIES / file).read_text(encoding="utf-8")))
    for picture in PICTURES:
        file = STUDIES / "figures" / f"{picture}.png"
        if file.exists():
            shutil.copy(file, ROOT / "docs" / file.name)
    for name, file in FIGURES.items():
        if file.exists():
            shutil.copy(file, ROOT / "docs" / f"{name}.png")


if __name__ == "__main__":
    main()
