"""Numbers of fixed small runs, which stand for the engine: validation/engine_numbers.json.

One coarse mesh of the reference blade and few revolutions of each kind of run, so that no motion is chaotic yet: after ten of
direct contact on patches, numbers of two processors differ by percents, after three by 1e-6.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from evidence.configuration import settings_of
from r37core.base.io import read_json, write_json
from r37core.fem.matrices import assemble
from r37core.mesh.generate import generate_mesh
from r37core.rom.contact_model import ContactModel
from r37core.rom.reduce import reduce_blade
from r37core.rom.reduced_model import ReducedModel, contact_model
from r37core.rom.reduction_choice import PATCHES
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE
from r37core.time_integration.simulate import DIRECTIONS
from r37core.time_integration.speed_run import run_speed
from r37studies.run_up_integration import RunUpIntegration
from r37studies.run_up_revolutions import record_run_up
from r37studies.run_up_schedule import RunUp

from .paper_box import BOX, box_operator

WITHIN = 1e-5
"""Relative difference between processors."""

_BLADE, _REVOLUTIONS = "Ref", 10
_SPEED = 1700.0
_DIRECT = {"speed": 1344.0, "revolutions": 3}
_MESH = {"nodes": 2500, "layers": 1, "tip_elements": 14}

Numbers = dict[str, dict[str, float]]


def measured(root: Path) -> Numbers:
    """The numbers, in nine digits: name of a kind of run -> quantity with its unit -> value."""
    settings = settings_of(root, scenes="all")
    blade, tip_line = settings.blades[_BLADE], settings.structure.boundary.tip_line
    mesh = generate_mesh(blade.shape.build(round_edges=True), **_MESH)
    matrices, boundary = assemble(mesh, blade.material), settings.boundary_choice(_BLADE)
    reduction, regions = settings.reduction_choice(_BLADE), settings.stress_regions(_BLADE)
    model = reduce_blade(mesh, matrices, blade.material, boundary, reduction, regions)
    patched = reduce_blade(mesh, matrices, blade.material, replace(boundary, contact=PATCHES), reduction, regions)
    contact, patches = (contact_model(each, tip_line) for each in (model, patched))

    def run(of: ContactModel, name: str, speed: float = _SPEED, results=(), stress=None, **changes) -> dict[str, float]:
        quiet = {"snapshot_revolutions": 2 if stress else 0, "revolutions": _REVOLUTIONS}
        choice = replace(settings.integration_choice(_BLADE, name), **quiet | changes)
        counts = {"spectrum_highest_order": 1, "wear_angles": 8, "stress": stress}
        return _of_run(run_speed(of, speed, settings.scenes[name].scene, choice, results, **counts))

    numbers = {
        "structure": _frequencies(model),
        "lined": run(contact, "abradable", results=["wear"]),
        "direct": run(contact, "direct", **_DIRECT),
        "central_difference": run(contact, "abradable", integrator=CENTRAL_DIFFERENCE, time_step=4e-7),
        "stress": run(contact, "abradable", results=["stress"], stress={BOX: box_operator(model, blade.material)}),
        "patches": run(patches, "direct", **_DIRECT),
        "clearance": run(contact, "growing_abradable"),
        "ring": run(contact, "elastic_abradable", results=["casing"]),
    }
    run_up = RunUp(1690.0, 1700.0, float(_REVOLUTIONS), 2, 2, False)
    choice = replace(settings.integration_choice(_BLADE, "abradable"), snapshot_revolutions=0)
    more = {"highest_order": 1, "stress": None, "yield_stress": np.inf}
    integration = RunUpIntegration(contact, settings.scenes["abradable"].scene, choice, run_up)
    numbers["run_up"] = _of_run(record_run_up(integration, (), **more))
    return {name: {key: float(f"{value:.9g}") for key, value in of.items()} for name, of in numbers.items()}


def _frequencies(model: ReducedModel) -> dict[str, float]:
    return {
        f"frequency {number} at {speed:g} rad/s (rad/s)": value
        for speed in (0.0, 2000.0)
        for number, value in enumerate(model.modes(speed, 3)[0], start=1)
    }


def _of_run(result: dict[str, np.ndarray]) -> dict[str, float]:
    """Rms of both corners in all directions (m), and one number of what else is there."""
    rms = {way: result[f"rms_{way}"].reshape(-1, 2)[-1] for way in DIRECTIONS}
    numbers = {f"rms {corner} {way} (m)": rms[way][i] for i, corner in enumerate(("leading", "trailing")) for way in DIRECTIONS}
    sums = {"wear": "wear (m)", "revolution_von_mises": "von Mises (Pa)", "casing_rms_forward": "casing, forward (m)"}
    return numbers | {f"sum of {label}": np.nansum(result[key]) for key, label in sums.items() if key in result}


def moved(known: Numbers, now: Numbers) -> list[str]:
    """Names of runs of which a number is new, gone or another one."""
    return sorted(
        name
        for name in {*known, *now}
        if known.get(name, {}).keys() != now.get(name, {}).keys()
        # of NaN no comparison is true
        or not all(abs(now[name][key] - value) <= WITHIN * abs(value) for key, value in known[name].items())
    )


def renew(input: Any, output: Any, params: Any) -> None:
    """Measure the numbers; what did not move stays as it is, whatever the processor. Output: the file, which may be there."""
    file = Path(output.numbers)
    known: Numbers = read_json(file) if file.exists() else {}
    now = measured(Path.cwd())
    changed = moved(known, now)
    write_json({name: now[name] if name in changed else known[name] for name in now}, file)
    print(f"{file}: {', '.join(changed) or 'nothing'} moved")
