"""The best designs as entries of a blades.yaml, and as STEP files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import xarray as xr
import yaml

from r37core.config.families import with_value
from r37core.io import write_text

_HEADER = """\
# The best designs of a search: entries to paste into your blades.yaml, or a file of its own with the blades they start from. To
# run them at another level, with tolerances or in other scenes:
#   snakemake all_blades --configfile config/config.yaml --config blades_file={file} blades='[{names}]' \\
#     fidelity=standard run='{{name: best}}'
"""


def entries_of(search: xr.Dataset, designs: Sequence[str], start: str, entries: Mapping[str, Any]) -> dict[str, Any]:
    """Name -> entry of some designs; `entries`: those that they start at, of which `start` is the last.

    A name is that of the start and of the design.
    """
    made: dict[str, Any] = {}
    for design in designs:
        content = dict(entries[start])
        for key, value in zip(search["variable"].values, search["value"].sel(design=design).values, strict=True):
            content = with_value(content, str(key).split("."), float(value))
        made[f"{start}_{design}"] = content
    return made


def write_entries(search: xr.Dataset, made: Mapping[str, Any], entries: Mapping[str, Any], file: Path | str) -> None:
    """Write the entries as YAML, each with what it gave, after those that they start at."""
    parts = [_HEADER.format(file=file, names=", ".join(made)), _text(entries)]
    for entry, content in made.items():
        of = search.sel(design=entry.rpartition("_")[2])
        values = [
            f"{objective} {float(value):.4g} {unit}"
            for objective, value, unit in zip(
                of["objective"].values, of["objective_value"].values, of["objective_unit"].values, strict=True
            )
        ]
        parts.append(f"# {', '.join(values)} (the start: {_start(search)})\n{_text({entry: content})}")
    write_text("\n".join(parts), file)


def _start(search: xr.Dataset) -> str:
    return ", ".join(f"{float(value):.4g}" for value in search["objective_value"].sel(design="start").values)


def _text(entries: Mapping[str, Any]) -> str:
    return yaml.safe_dump(dict(entries), sort_keys=False, width=120, default_flow_style=None)
