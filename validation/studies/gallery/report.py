"""Our counterpart of every result figure of the paper, from the results of a sweep, and what agrees under each."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from r37core.dataset_file import read_dataset
from r37core.mesh.mesh_files import read_vtu
from r37core.plain import from_plain
from r37core.product.reporting import CAPTIONS
from r37core.results.measures import peak_of, strongest_order
from r37core.rom.reduction_choice import StressSubmesh
from validation.published import BLADES, INTERACTIONS, MESH_NODES, REFERENCE
from validation.studies.checks import Check, number, ran, with_histories
from validation.studies.modelling_choices.cases import DIRECT
from validation.studies.modelling_choices.validation import choice_checks, structure_checks, survey_checks

from .captions import CAPTIONS as OWN_CAPTIONS
from .cases import COARSE, FINE, ITEMS, REVOLUTION, RUNS_OF_SWEEP, WINDOW, Item
from .figures import GalleryData, gallery_figures
from .shapes import draw_mesh, draw_modes, draw_variants

_FIRST_LOBES = 2.5
"""Engine orders of the motion above the casing's own: it has two lobes."""

_LISTED = 4


def report(responses: Mapping[str, xr.Dataset], files: Any, values: Mapping[str, Any]) -> dict[str, Any]:
    """The page and its pictures; the rendered ones are drawn into their files."""
    data = gallery_data(responses, files, values)
    meshes = dict(zip(BLADES, files.meshes, strict=True))
    reference = meshes.pop(REFERENCE)
    nodes = len(read_vtu(reference).points)
    rendered = {
        "modes": partial(draw_modes, Path(files.modes) / "modes_0.vtu"),
        "mesh": partial(draw_mesh, reference, from_plain(StressSubmesh, values["submesh"])),
        "variants": partial(draw_variants, meshes, reference),
    }
    page = gallery_page(data, read_dataset(files.geometry), nodes, values["fidelity"])
    return {"page": page, **gallery_figures(data), **rendered}


def gallery_data(responses: Mapping[str, xr.Dataset], files: Any, values: Mapping[str, Any]) -> GalleryData:
    """From the responses of the sweep, and those of the cases beside it."""
    swept = {run: read_dataset(file) for run, file in zip(RUNS_OF_SWEEP, files.responses, strict=True)}
    histories = {run: ran(responses["__".join(run)], "__".join(run)) for run in RUNS_OF_SWEEP}
    shipped = {
        row.name: swept[row.blade, "lined"].sel(speed=slice(WINDOW[0] * row.campbell, WINDOW[1] * row.campbell))
        for row in INTERACTIONS
    }
    shipped |= {f"{blade}_4": with_histories(shipped[f"{blade}_4"], histories[blade, "lined"]) for blade in BLADES}
    direct = swept[REFERENCE, "direct"]
    shipped[DIRECT] = with_histories(direct, histories[REFERENCE, "direct"])
    return GalleryData(
        {blade: read_dataset(file) for blade, file in zip(BLADES, files.campbells, strict=True)},
        swept,
        shipped,
        {"Ref_lined": swept[REFERENCE, "lined"], "Ref_direct": direct, "CS100_lined": swept["CS100", "lined"]},
        ran(responses[REVOLUTION], REVOLUTION)["max_von_mises_of_instant"].values[0],
        values["scenes"],
    )


def gallery_checks(data: GalleryData, geometry: xr.Dataset, nodes: int) -> list[Check]:
    """All checks: those of the modelling choices, and a few that only pictures need. `nodes`: of the reference blade's mesh."""
    campbells, shipped = data.campbells, data.shipped
    rest = float(campbells[REFERENCE]["frequency"].sel(mode="1B", speed=0.0))
    loss = 1.0 - data.revolution[:: FINE // COARSE].max() / data.revolution.max()
    text = f"{100 * loss:.2g}% below that of {FINE}"
    orders = {name: strongest_order(peak_of(run)["amplitude"], above=_FIRST_LOBES) for name, run in shipped.items()}
    at_peak = "engine order of the largest amplitude at the peak"
    return [
        *structure_checks(geometry, campbells),
        *choice_checks(shipped),
        *survey_checks(data.survey, shipped),
        Check("Ref: 1B at rest, through the published crossings", _at_rest(), rest, "Hz"),
        Check("mesh: nodes", float(MESH_NODES), float(nodes), "", 0.05),
        Check(f"largest stress of the last revolution from {COARSE} instants", None, text),
        *(Check(f"{row.label}: {at_peak}", float(row.engine_order), orders[row.name], "", 0.01) for row in INTERACTIONS),
        Check("direct, engine order of the largest amplitude at the largest rms", None, orders[DIRECT]),
    ]


def _at_rest() -> float:
    """Frequency (Hz) of the reference blade's 1B at rest: f^2 = f0^2 + s speed^2 through its published Campbell speeds."""
    crossings = [row for row in INTERACTIONS if row.blade == REFERENCE]
    speed = np.array([row.campbell for row in crossings])
    frequency = np.array([row.engine_order for row in crossings]) * speed / (2.0 * np.pi)
    _, square = np.polyfit(speed**2, frequency**2, 1)
    return float(np.sqrt(square))


def of_item(item: Item, checks: Iterable[Check]) -> list[Check]:
    """The checks that belong to a figure."""
    return [check for check in checks if any(re.search(pattern, check.name) for pattern in item.checks)]


def verdict(checks: Sequence[Check]) -> str:
    """What agrees with the published values, what does not, and what is ours alone, each as a list."""
    scored = [check for check in checks if check.published is not None]
    agreeing, differing = ([check for check in scored if check.agrees == agrees] for agrees in (True, False))
    agreed = [_summed(agreeing)] if len(agreeing) > _LISTED else [_one(check) for check in agreeing]
    groups = {
        f"**Agrees** ({len(agreeing)} of {len(scored)}):": agreed,
        "**Does not agree**:": [_one(check) for check in differing],
        "Ours alone:": [f"{check.name} {_with_unit(check)}" for check in checks if check.published is None],
    }
    return "\n\n".join("\n".join([head, "", *(f"- {item}" for item in items)]) for head, items in groups.items() if items)


def _one(check: Check) -> str:
    if isinstance(check.published, str):
        return check.name + (f" ({check.detail})" if check.detail else "")
    return f"{check.name} {_with_unit(check)} (published {number(check.published)})"


def _summed(checks: Sequence[Check]) -> str:
    """Many that agree: the one with the largest error, and how many statements."""
    numbers = [check for check in checks if not isinstance(check.published, str)]
    statements = len(checks) - len(numbers)
    parts = []
    if numbers:
        worst = max(numbers, key=lambda check: check.error)
        parts.append(f"{len(numbers)} numbers, the largest difference {100 * worst.error:.2g}%, {_one(worst)}")
    if statements:
        parts.append(f"{statements} statement{'s' if statements > 1 else ''}")
    return " and ".join(parts)


def _with_unit(check: Check) -> str:
    """Our number with its unit, then the detail."""
    unit = f" {check.unit}" if check.unit else ""
    return number(check.ours) + unit + (f" ({check.detail})" if check.detail else "")


def gallery_page(data: GalleryData, geometry: xr.Dataset, nodes: int, fidelity: str) -> str:
    """The page docs/gallery.md, with the pictures in a folder of its name."""
    checks = gallery_checks(data, geometry, nodes)
    lines = [
        "# Gallery",
        "",
        "Our counterpart of every result figure of the paper, made by `snakemake gallery` from the default sweep at level "
        f"`{fidelity}` and a few runs beside it. Numbers under a figure are generated; a published one agrees within "
        "the bound of [validation.md](validation.md#as-shipped), which counts how many agree, at the published step.",
    ]
    for item in ITEMS:
        lines += ["", f"## {item.title}", "", f"![{item.title}](gallery/{item.name}.png)", "", _caption(item, data)]
        lines += ["", verdict(of_item(item, checks))]
    return "\n".join(lines) + "\n"


def _caption(item: Item, data: GalleryData) -> str:
    kind, _, scene = item.name.partition("_")
    if kind == "spectrum":
        return CAPTIONS[kind].format(blade=REFERENCE, scene=data.scenes[scene])
    return (OWN_CAPTIONS | CAPTIONS)[item.name].format(blade=REFERENCE)
