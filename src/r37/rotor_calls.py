"""The call of whole rotors: every blade of a shape, on one lining."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, Unpack

import xarray as xr

from r37core.config import ConfigError
from r37core.config.scenes import OF_ONE_BLADE
from r37core.plans.paths import fill
from r37core.rotors.plan import ROTOR_OF_RUN

from .arguments import Speeds, speed_keys
from .call_settings import call_of, chosen_scene
from .choices import BladeChoice, SceneChoice
from .runs import SweepOptions, run_of
from .stages import checked_call


@checked_call
def rotor(
    blade: BladeChoice | str,
    scene: SceneChoice | str,
    speeds: Speeds | None = None,
    *,
    rotor: Mapping[str, Any] | None = None,
    **options: Unpack[SweepOptions],
) -> xr.Dataset:
    """Response of all blades of a rotor in a scene at several speeds, as in rotor.nc of a run.

    All blades wear one lining.

    Args:
        rotor: The section `rotor` of the scene, in the units of its keys: `{"blades": 36, "mistuning_spread_percent":
            {"normal": 1}}`. It may be left out for a scene that has a rotor. Otherwise the scene's keys stay where this has
            none of them.
        results: Results to compute, in place of the scene's list. By default, where `rotor` is given, it is that list
            without `signal` and `shapes`, which are of a single blade.

    Returns:
        By ascending speed. `blade_rms` (m) of the leading edge's displacement, normal and tangential together, and
        `blade_max_von_mises` (Pa), shape (speed, blade_number). `blade_maximum` (m), shape (speed, blade_number, span),
        largest over spans of revolutions. `leader`, shape (speed,), number of the blade with the largest `blade_rms`.
        `nodal_diameter_share`, shape (speed, nodal_diameter), and others.

    Raises:
        ConfigError: For bad input, and for a scene without a rotor.
        ValueError: For an impossible shape, mesh, model or time step.

    Examples:
        >>> mistuned = {"blades": 3, "mistuning_percent": {2: 1.0}}
        >>> all_blades = r37.rotor("Ref", "abradable", [1150, 1550], rotor=mistuned, fidelity="draft")
        >>> all_blades.blade_rms.sizes["blade_number"]
        3
        >>> all_blades.leader.sel(speed=1550).item() in (1, 2, 3)
        True
    """
    call = call_of("r37.rotor", [blade], [scene], speed_keys(speeds, options.get("speeds_rpm")), options)
    (single,), results = call.scenes, options.get("results")
    if rotor is not None:
        if results is None:
            results = [result for result in single.entry.results if result not in OF_ONE_BLADE]
        all_blades = replace(single, changes={**single.changes, "rotor": rotor})
        call = replace(call, scenes=[chosen_scene(all_blades, call.base, results)])
    elif single.entry.rotor is None:
        raise ConfigError(f'scene: found {single.label}, without a rotor; allowed: one with it, or rotor={{"blades": 36}}')
    names = {"blade": call.blades[0].name, "scene": single.name}
    return run_of(call, options, fill(ROTOR_OF_RUN, **names)).rotor(**names).assign_attrs(call.told)
