"""Where the files lie that more than one rule speaks of, as Snakemake's patterns.

`<results>` and `<logs>` are folders of the run; what stands in braces are wildcards. Two underscores separate names. `{member}`
is empty for the nominal sweep, and `folder/name/` for what a member of a sample has in its place (samples.py).
"""

from collections.abc import Iterable, Sequence
from typing import Any

from r37core.base.speeds import exact_text

GEOMETRY = "<results>/{member}{blade}/geometry.nc"
MESH = "<results>/{member}{blade}/mesh.vtu"
REDUCED_MODEL = "<results>/{member}{blade}/rom_{tip_line}.nc"
CONTACT_MODEL = "<results>/{member}{blade}/contact_{tip_line}.npz"
STRESS_OPERATOR = "<results>/{member}{blade}/stress_{tip_line}.npz"
CAMPBELL = "<results>/{member}{blade}/campbell.nc"
INTEGRATION_STAMP = "<results>/{member}{blade}/{scene}/time_integration.stamp"
ROUND = "<results>/{member}{blade}/{scene}/round_{round}.json"
SPEED = "<results>/{member}{blade}/{scene}/speed_{speed}.npz"
RESPONSE = "<results>/{member}{blade}/{scene}/response.nc"
WHOLE_BLADE_MODEL = "<results>/{blade}/whole_blade_{tip_line}.nc"


def fill(pattern: str, **wildcards: Any) -> str:
    """The pattern with its wildcards replaced; without a member it is the nominal file."""
    return pattern.format(**{"member": "", **wildcards})


def nominal(pattern: str) -> str:
    """The pattern of the files of the nominal sweep alone."""
    return pattern.replace("{member}", "")


def speed_files(member: str, wildcards: Any, speeds: Sequence[float]) -> list[str]:
    """Files of the simulations of a member's blade and scene at some speeds (rad/s)."""
    of = {"member": member, "blade": wildcards.blade, "scene": wildcards.scene}
    return [fill(SPEED, **of, speed=exact_text(speed)) for speed in speeds]


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
    return [fill(pattern, **wildcards) for pattern, several in patterns.items() for wildcards in several]


def pictures(name: str, wildcards: Wildcards) -> dict[str, Wildcards]:
    """A figure in both of its formats."""
    return {f"<results>/figures/{name}.{suffix}": wildcards for suffix in ("png", "pdf")}
