"""The call of whole rotors: every blade of a shape, on one lining."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, Unpack

import xarray as xr

from r37core.config import ConfigError
from r37core.config.scenes import OF_ONE_BLADE
from r37core.plans.paths import fill
from r37core.rotors.plan import ROTOR_OF_RUN

from .arguments import Speeds, speed_keys
from .call_configuration import Configuration
from .call_settings import base_of, chosen_blade, chosen_scene
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
    """Every blade of a whole rotor in a scene at several speeds, as rotor.nc of a run: all blades wear one lining.

    Parameters
    ----------
    blade
        The shape of all blades: a name, or what `r37.blade` gives.
    scene
        A name, or what `r37.scene` gives.
    speeds, speeds_rpm
        As of `r37.sweep`.
    rotor
        The section `rotor` of the scene, in the units of its keys: `{"blades": 36, "mistuning_spread_percent": {"normal": 1}}`.
        A scene that has a rotor needs none; its keys stay where this has none of them.
    fidelity, config, cores, folder
        As of `r37.run`.
    results
        What is computed, in place of the scene's list. Where `rotor` is given, it is that list without `signal` and `shapes`,
        which are of a single blade.

    Returns
    -------
    Dataset
        By ascending speed and `blade_number`: `blade_rms` (m) and, over spans of revolutions, `blade_maximum` (m), of the
        leading edge's displacement, normal and tangential together; `leader`, the blade with the largest `blade_rms`;
        `blade_max_von_mises` (Pa), `nodal_diameter_share` and others.

    Raises
    ------
    ConfigError
        For bad input, and for a scene without a rotor. A shape, mesh, model or time step that is impossible raises a
        ValueError of its own.

    Examples
    --------
    >>> mistuned = {"blades": 3, "mistuning_percent": {2: 1.0}}
    >>> all_blades = r37.rotor("Ref", "abradable", [1150, 1550], rotor=mistuned, fidelity="draft")
    >>> all_blades.blade_rms.sizes["blade_number"]
    3
    >>> all_blades.leader.sel(speed=1550).item() in (1, 2, 3)
    True
    """
    chosen = chosen_blade(blade, options.get("config"))
    rubs_on = _with_rotor(scene, base_of([chosen], options.get("config")), rotor, options.get("results"))
    file = fill(ROTOR_OF_RUN, blade=chosen.name, scene=rubs_on.name)
    keys = speed_keys(speeds, options.get("speeds_rpm"))
    results = run_of("r37.rotor", [chosen], [rubs_on], keys, options, file)
    return results.rotor(chosen.name, rubs_on.name).assign_attrs(chosen.told | rubs_on.told)


def _with_rotor(
    scene: SceneChoice | str, base: Configuration, rotor: Mapping[str, Any] | None, results: Sequence[str] | None
) -> SceneChoice:
    """The scene, with the rotor where one is given. Raises ConfigError."""
    if rotor is None:
        chosen = chosen_scene(scene, base, results)
        if chosen.entry.rotor is None:
            raise ConfigError(f'scene: found {chosen.label}, without a rotor; allowed: one with it, or rotor={{"blades": 36}}')
        return chosen
    single = chosen_scene(scene, base)
    if results is None:
        results = [result for result in single.entry.results if result not in OF_ONE_BLADE]
    return chosen_scene(replace(single, changes={**single.changes, "rotor": rotor}), base, results)
