"""Rotors against a single blade: speeds above yield, and how many blades are above it at once."""

from typing import Any

import numpy as np

from r37core.base.dataset_file import read_dataset
from r37core.results.danger import ratio_to_yield
from r37core.results.exceedance import length_of, ranges_above
from r37core.results.regions import read_judged
from r37core.time_integration.status import RunStatus

from .tables import write_table

SINGLE = "single"
BLADES = ("Ref", "CS100")
"""Blades of the rotors: without sweep, and with most speeds above yield on a lining."""

KINDS = {
    "equal": "36 equal blades",
    "mistuned_1": "1% of mistuning",
    "mistuned_1_other": "1%, another draw",
    "mistuned_1_third": "1%, a third draw",
}
"""Rotors of validation/decisions.yaml."""


def kinds(input: Any, output: Any, params: Any) -> None:
    """Speeds above yield of a single blade and of rotors of it. Inputs: files of BLADES by scene. Output: table."""
    rows = []
    for place, blade in enumerate(BLADES):
        rows.append([blade, "a single blade", *_single(input[SINGLE][place])])
        rows += [[blade, words, *_rotor(input[kind][place])] for kind, words in KINDS.items()]
    write_table(["blade", "rotor", "above yield (rad/s)", "largest stress / yield", "most blades at once"], rows, output.table)


def _single(file: str) -> list[str]:
    ratio = ratio_to_yield(read_judged(file))
    return [*_length(ratio["speed"].values, ratio.values), "1"]


def _rotor(file: str) -> list[str]:
    """Length, largest stress and blades at once of a rotor; infinite where the run diverged."""
    rotor = read_dataset(file)
    worst = rotor["blade_max_von_mises_ever"].max("blade_number") / rotor["yield_stress"]
    ratio = worst.where(rotor["status"] != RunStatus.DIVERGED, np.inf)
    most = (rotor["blades_ever_above_yield"] * rotor.sizes["blade_number"]).max()
    return [*_length(rotor["speed"].values, ratio.values), f"{float(most):.0f}"]


def _length(speeds: np.ndarray, ratio: np.ndarray) -> list[str]:
    return [f"{length_of(ranges_above(speeds, ratio, 1.0)):.0f}", f"{ratio.max():.2f}"]
