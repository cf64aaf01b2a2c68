"""Where the files lie that more than one rule speaks of, as Snakemake's patterns.

`<results>` and `<logs>` are folders of the run; what stands in braces are wildcards. Two underscores separate names.
"""

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from r37core.base.speeds import exact_text

GEOMETRY = "<results>/{blade}/geometry.nc"
MESH = "<results>/{blade}/mesh.vtu"
REDUCED_MODEL = "<results>/{blade}/rom_{tip_line}.nc"
CONTACT_MODEL = "<results>/{blade}/contact_{tip_line}.npz"
STRESS_OPERATOR = "<results>/{blade}/stress_{tip_line}.npz"
CAMPBELL = "<results>/{blade}/campbell.nc"
INTEGRATION_STAMP = "<results>/{blade}/{scene}/time_integration.stamp"
ROUND = "<results>/{blade}/{scene}/round_{round}.json"
SPEED = "<results>/{blade}/{scene}/speed_{speed}.npz"
RESPONSE = "<results>/{blade}/{scene}/response.nc"
WHOLE_BLADE_MODEL = "<results>/{blade}/whole_blade_{tip_line}.nc"


def speed_files(wildcards: Any, speeds: Sequence[float]) -> list[str]:
    """Files of the simulations of a blade and scene at some speeds (rad/s)."""
    return [SPEED.format(blade=wildcards.blade, scene=wildcards.scene, speed=exact_text(speed)) for speed in speeds]


def speed_of(file: Path | str) -> float:
    """Speed (rad/s) of the file of a simulation."""
    return float(Path(file).stem.removeprefix("speed_"))


Wildcards = list[dict[str, str]]
"""Wildcards of several files with one pattern."""


def of(name: str, values: Iterable[str]) -> Wildcards:
    """Files of one wildcard."""
    return [{name: value} for value in values]


def run_keys(runs: Iterable[tuple[str, str]]) -> Wildcards:
    """Files of pairs of blade and scene."""
    return [{"blade": blade, "scene": scene} for blade, scene in runs]


def filled(patterns: dict[str, Wildcards]) -> list[str]:
    """The files that patterns and their wildcards stand for."""
    return [pattern.format(**wildcards) for pattern, several in patterns.items() for wildcards in several]
