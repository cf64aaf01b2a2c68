"""The best designs as entries of a blades.yaml, and as STEP files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import xarray as xr

from r37core.config.families import with_value
from r37core.io import write_text
from r37core.yaml_file import yaml_text

from .choice import START

_HEADER = """\
# The best designs of a search: entries to paste into your blades.yaml, or a file of its own with the blades they start from. To
# run them at another level, with tolerances or in other scenes:
#   snakemake all_blades --configfile config/config.yaml --config blades_file={file} blades='[{names}]' \\
#     fidelity=standard run='{{name: best}}'
"""


def entries_of(search: xr.Dataset, designs: Sequence[str], start: str, entries: Mapping[str, Any]) -> dict[str, Any]:
    """Name (`start` with _best1, _best2, ...) -> entry of some designs, the best first, made of the `entries` of the start."""
    made: dict[str, Any] = {}
    for place, design in enumerate(designs, 1):
        content = dict(entries[start])
        for key, value in zip(search["variable"].values, search["value"].sel(design=design).values, strict=True):
            content = with_value(content, str(key).split("."), float(value))
        made[f"{start}_best{place}"] = content
    return made


def write_entries(
    search: xr.Dataset, made: Mapping[str, Any], designs: Sequence[str], entries: Mapping[str, Any], file: Path | str
) -> None:
    """Write the entries of the `designs` as YAML, each with what it gave, after those that they start at."""
    parts = [_HEADER.format(file=file, names=", ".join([list(entries)[-1], *made])), yaml_text(dict(entries))]
    for (name, content), design in zip(made.items(), designs, strict=True):
        parts.append(
            f"# {design}: {_objectives(search, design)}; the start: {_objectives(search, START)}\n{yaml_text({name: content})}"
        )
    write_text("\n".join(parts), file)


def _objectives(search: xr.Dataset, design: str) -> str:
    of = search.sel(design=design)
    values = zip(of["objective"].values, of["objective_value"].values, of["objective_unit"].values, strict=True)
    return ", ".join(f"{name} {float(value):.4g} {unit}" for name, value, unit in values)
