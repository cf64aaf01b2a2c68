"""Families of swept and leaned designs in both scenes: table and picture of docs/blades.md. Run: make claims ONLY=designs.

It runs the workflow, at draft with adaptive speeds, into results/runs/designs (about ten minutes).
"""

import shutil
import subprocess
import sys
from pathlib import Path

from scipy.stats import spearmanr

from r37core.io import write_text
from r37core.results.table_file import read_table
from validation.studies.tables import markdown_table

ROOT = Path(__file__).parents[2]
STUDIES, RUN = ROOT / "results/studies", ROOT / "results/runs/designs"
FAMILIES = """
Sweep:
  base: S100
  vary: { sweep_percent: { start: -50, stop: 150, step: 25 } }
Lean:
  base: L100
  vary: { lean_percent: [-100, 0, 50, 100, 200] }
"""
SCENES = {"abradable": "lined", "direct": "direct"}
LEFT = {"clearance_loss_1t_m": "loss of clearance, 1T", "clearance_loss_1b_m": "loss of clearance, 1B",
        "frequency_1t_hz": "1T at rest", "frequency_1b_hz": "1B at rest"}  # fmt: skip


def run():
    """The designs, at draft."""
    file = STUDIES / "designs_blades.yaml"
    write_text((ROOT / "config/blades.yaml").read_text(encoding="utf-8") + FAMILIES, file)
    changes = [f"blades_file={file.relative_to(ROOT)}", "blades=[Sweep, Lean]", "fidelity=draft", "run={name: designs}"]
    wanted = [RUN / "designs.csv", RUN / "figures/designs_Sweep.png", RUN / "rms.nc", RUN / "campbell.nc"]
    targets = [str(one.relative_to(ROOT)) for one in wanted]
    subprocess.run([sys.executable, "-m", "snakemake", "--cores", "2", *targets, "--config", *changes], cwd=ROOT, check=True)


def table(designs):
    """A row for each design: structure, then both scenes."""
    rows = []
    for blade, of in designs.groupby("blade", sort=False):
        first, family = of.iloc[0], blade.split("_")[0].lower()
        percent = first[f"{family}_percent"]
        cells = []
        for scene in SCENES:
            (one,) = of[of["scene"] == scene].itertuples()
            cells += [
                f"{one.length_certain_rad_s:.0f}, {one.length_possible_rad_s:.0f}",
                f"{1e-9 * one.largest_median_stress_pa:.1f}",
            ]
        losses = (f"{1e3 * first[f'clearance_loss_{mode}_m']:.2f}" for mode in ("1b", "1t"))
        rows.append([f"{family} {percent:g}%", f"{first['frequency_1b_hz']:.0f}", *losses, *cells])
    head = ["design", "1B (Hz)", "loss of clearance, 1B (mm)", "1T (mm)"]
    head += [f"{words}: {what}" for words in SCENES.values() for what in ("above yield (rad/s)", "stress (GPa)")]
    return markdown_table(head, rows)


def correlations(designs):
    """Rank correlation of what a design is with the lengths of speed above yield."""
    rows = []
    for name, words in LEFT.items():
        cells = []
        for scene in SCENES:
            of = designs[designs["scene"] == scene]
            cells += [f"{spearmanr(of[name], of[f'length_{kind}_rad_s']).statistic:.2f}" for kind in ("certain", "possible")]
        rows.append([words, *cells])
    head = ["rank correlation of", *(f"{words}: {kind}" for words in SCENES.values() for kind in ("certain", "possible"))]
    return markdown_table(head, rows)


def main():
    """Run, and write the tables."""
    run()
    designs = read_table(RUN / "designs.csv")
    write_text(table(designs), STUDIES / "designs.md")
    write_text(correlations(designs), STUDIES / "designs_correlations.md")
    shutil.copy(RUN / "figures/designs_Sweep.png", STUDIES / "designs_Sweep.png")


if __name__ == "__main__":
    main()
