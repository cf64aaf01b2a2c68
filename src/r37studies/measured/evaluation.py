"""Simulations of the designs of a calibration."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from math import inf
from pathlib import Path
from typing import Any

import numpy as np

from r37core.base.varied_number import VariedNumber
from r37core.config import ConfigError, Settings, varied_settings
from r37core.config.changed_numbers import ImpossibleValueError
from r37core.fem.equilibrium import NoEquilibriumError
from r37core.machine_code.kept import content_digest
from r37core.mesh.mesh_files import read_vtu
from r37core.rom.contact_model import read_contact_model
from r37core.rom.rom_file import read_reduced_model
from r37core.rom.rotation import BucklingError
from r37core.sweep.blade_sweep import blade_sweep
from r37core.sweep.driver import RunAll
from r37core.sweep.parts import Parts
from r37core.sweep.recipe import STRUCTURES, code_of, structure_attributes
from r37core.time_integration.clearance import NoRoomError
from r37core.time_integration.integration_choice import IntegrationChoice
from r37studies.gauges import gauge_rows

from .calibration_plan import FREQUENCIES, Calibrated
from .observed import ObservedBlade, arrays_of
from .points import TIP_TIMING, Measurement

Values = dict[str, list[float]]

_FRICTION = (0.999, 1.0, 1.001)
"""Factors of friction whose runs have their mean taken on a bare casing."""


def observed_blade(
    files: Any, measurements: Mapping[str, Measurement], choice: IntegrationChoice, tip_line: str, folder: Path
) -> ObservedBlade:
    """A blade in a scene to be observed. Files: model, and rom of tip timing, mesh and whole of strain; runs lie in `folder`.

    Raises ValueError for a gauge that is not on the blade.
    """
    made_of = [content_digest(files.model), code_of("r37studies.measured.steps.observe")]
    parts = Parts(folder, made_of, arrays_of(measurements))
    blade = ObservedBlade(read_contact_model(files.model), choice, measurements, parts)
    strains = [each.gauge for each in measurements.values() if each.gauge is not None]
    if strains:
        whole = read_reduced_model(files.whole).whole_blade
        assert whole is not None
        blade = replace(blade, strains=gauge_rows(read_vtu(files.mesh), whole.basis, strains)[0])
    if any(each.quantity == TIP_TIMING for each in measurements.values()):
        blade = replace(blade, tip=read_reduced_model(files.rom).tip_lines[tip_line])
    return blade


def simulate(
    settings: Settings,
    blades: Mapping[tuple[str, str], ObservedBlade],
    folder: Path,
    run_all: RunAll,
    designs: Mapping[str, Mapping[VariedNumber, float]],
) -> Sequence[Values | str]:
    """Simulated values of each measurement, by name, of designs; or why one cannot be run.

    `blades` of the configuration by blade and scene, with files in a `folder`.
    """
    return list(run_all([partial(_design, settings, blades, folder, *design) for design in designs.items()], "designs"))


def _design(
    settings: Settings,
    blades: Mapping[tuple[str, str], ObservedBlade],
    folder: Path,
    name: str,
    values: Mapping[VariedNumber, float],
) -> Values | str:
    simulated: Values = {}
    try:
        for (blade, scene), observed in blades.items():
            changed, other = settings.made(Calibrated).changed(blade, scene, values)
            made_of = observed.parts.made_of
            if changed.elastic != settings.blades[blade].elastic:
                varied = varied_settings(settings, {blade: changed}, {})
                (structures := folder / STRUCTURES).mkdir(parents=True, exist_ok=True)
                sweep, attributes = blade_sweep(varied, blade, scene, kept=False), structure_attributes(settings, blade)
                file = sweep.file("contact_model", structures, attributes)
                observed, made_of = replace(observed, model=read_contact_model(file)), [content_digest(file), made_of]
            if percent := values.get(FREQUENCIES):
                squares = (0.01 * percent) ** 2 * observed.model.squared_frequencies
                observed, made_of = (
                    replace(observed, model=replace(observed.model, squared_frequencies=squares)),
                    [percent, made_of],
                )
            parts = replace(observed.parts, folder=folder / name / blade / scene, made_of=made_of)
            runs = replace(observed, parts=parts)
            # on a bare casing a single run is a matter of chance
            scenes = [other.scaled_friction(factor) or other for factor in ((1.0,) if other.lined else _FRICTION)]
            several = [dict(part[:2] for part in runs.simulated(each)) for each in scenes]
            means = {measured: np.mean([each[measured] for each in several], axis=0) for measured in several[0]}
            simulated |= {measured: np.nan_to_num(values, nan=inf).tolist() for measured, values in means.items()}
    except (ConfigError, ImpossibleValueError, BucklingError, NoEquilibriumError, NoRoomError) as error:
        return str(error)
    return simulated
