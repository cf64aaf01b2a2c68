"""Evaluation of the designs of a search: their shapes, models and runs, and the quantities that follow."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from r37core.base.dataset_file import read_dataset
from r37core.base.io import Named, read_json, write_json
from r37core.base.plain import to_plain
from r37core.config import ConfigError, Settings, operating_range
from r37core.config.changed_numbers import ImpossibleValueError
from r37core.fem.equilibrium import NoEquilibriumError
from r37core.machine_code.kept import kept_file
from r37core.plans.sweep_plan import Sweep
from r37core.results.ranking import robustness
from r37core.results.regions import read_judged
from r37core.rom.contact_model import read_contact_model
from r37core.rom.rotation import BucklingError
from r37core.stress.operator import judged_operator, read_stress_operators
from r37core.sweep.blade_sweep import CAMPBELL, BladeSweep, SharedSpeeds, blade_sweep, shared_speeds
from r37core.sweep.driver import Driver, RunAll, one_by_one
from r37core.sweep.recipe import STRUCTURES, Recipe, code_of, recipes, structure_attributes
from r37core.time_integration.clearance import NoRoomError

from .designs import choice_of, designs_of
from .measures import MINIMISED
from .quantity import contact_value, static_stress, structure_value

_STRUCTURE = ("geometry", CAMPBELL, "contact_model", "stress_operator")


class Refused(ValueError):
    """A design that cannot be built; the message says why."""


@dataclass(frozen=True)
class DesignRuns:
    """Runs of a design: `structure`, recipes of its own blade, and of each scene its `settings`, its sweep and its speeds."""

    settings: Mapping[str, Settings]
    structure: Mapping[str, Recipe]
    scenes: Mapping[str, BladeSweep]
    speeds: Mapping[str, SharedSpeeds]

    @property
    def made_of(self) -> list[Any]:
        """All that they follow from, as plain values."""
        return to_plain([*(part.made_of for part in self.structure.values()), self.scenes, self.speeds])


@dataclass(frozen=True)
class Evaluation:
    """Evaluation of the designs of the search of these `settings`, with files in a `folder`, on so many `cores`."""

    settings: Settings
    folder: Path
    run_all: RunAll
    cores: int

    @property
    def _blade(self) -> str:
        return designs_of(self.settings).entry.blade

    @property
    def _structures(self) -> Path:
        return self.folder / STRUCTURES

    def quantities(self, designs: Mapping[str, Sequence[float] | None]) -> list[dict[str, Any] | str]:
        """Quantities of designs by the values of their variables (None: the start), or why one cannot be built."""
        self._structures.mkdir(parents=True, exist_ok=True)
        if len(designs) < self.cores:
            return [self._quantities(name, values, self.run_all) for name, values in designs.items()]
        calls = [partial(self._quantities, name, values, one_by_one) for name, values in designs.items()]
        return list(self.run_all(calls, "designs"))

    def _quantities(self, name: str, values: Sequence[float] | None, run_all: RunAll) -> dict[str, Any] | str:
        try:
            runs = self.runs(name, values)
            quantities = {name: each.made_of for name, each in choice_of(self.settings).quantities.items()}
            wanted = to_plain([quantities, operating_range(self.settings)])
            made_of = [*runs.made_of, code_of("r37studies.search.steps.search"), wanted]
            (folder := self.folder / name).mkdir(parents=True, exist_ok=True)
            return read_json(kept_file("quantities.json", made_of, partial(self._measure, name, runs, run_all), folder))
        except (ConfigError, ImpossibleValueError, Refused, BucklingError, NoEquilibriumError, NoRoomError) as error:
            return str(error)

    def runs(self, name: str, values: Sequence[float] | None) -> DesignRuns:
        """Runs of a design. Raises ConfigError and ImpossibleValueError for one that is impossible."""
        scene_settings, blade = designs_of(self.settings).design_settings(name, values), self._blade
        first = next(iter(scene_settings.values()))
        # the user's cache keeps the model of the start
        kept = first.blades[blade].elastic == self.settings.blades[blade].elastic
        sweeps = {scene: blade_sweep(varied, blade, scene, kept=kept) for scene, varied in scene_settings.items()}
        speeds = {scene: shared_speeds(varied, blade, scene) for scene, varied in scene_settings.items()}
        return DesignRuns(scene_settings, recipes(first, blade, dict.fromkeys(_STRUCTURE), kept=kept), sweeps, speeds)

    def _measure(self, name: str, runs: DesignRuns, run_all: RunAll, file: Path) -> None:
        """Build the design, run it, and write its quantities. Raises Refused where it cannot be built."""
        blade, attributes = self._blade, structure_attributes(self.settings, self._blade)
        try:
            made = {stage: part.file(self._structures, attributes) for stage, part in runs.structure.items()}
        except ValueError as error:
            # of a shape, of its mesh, or of a region of the stress without elements
            raise Refused(str(error)) from None
        operating, quantities = operating_range(self.settings), choice_of(self.settings).quantities
        measures = {}
        for scene, sweep in runs.scenes.items():
            driver = Driver(self.folder / name / scene, self._structures, attributes, run_all)
            about = str(Sweep(runs.settings[scene]).provenance(Named(blade=blade, scene=scene)))
            (response,) = driver.run({name: sweep}, runs.speeds[scene], made[CAMPBELL], {name: about}).values()
            measures[scene] = robustness(read_judged(response), operating=operating)
        highest = self.settings.structure.maximum_speed_rad_s
        speeds = sorted({quantity.speed_rad_s or highest for quantity in quantities.values()})
        stiffening = read_contact_model(made["contact_model"]).rotation_stiffening
        stress = static_stress(judged_operator(read_stress_operators(made["stress_operator"])), stiffening, speeds)
        material = next(iter(runs.settings.values())).blades[blade].material
        assert material is not None
        mass = material.density * float(read_dataset(made["geometry"])["volume"])
        campbell = read_dataset(made[CAMPBELL])
        values = {
            name: contact_value(quantity, measures)
            if quantity.measure in MINIMISED
            else (structure_value(quantity, mass, campbell, stress, highest), 0.0)
            for name, quantity in quantities.items()
        }
        known = {name: [number if math.isfinite(number) else None for number in value] for name, value in values.items()}
        write_json(known, file)
