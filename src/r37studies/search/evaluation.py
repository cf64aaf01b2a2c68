"""Evaluation of the designs of a search: their shapes, models and runs, and the quantities that follow."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from pathlib import Path
from typing import Any

import numpy as np

from r37core.base.dataset_file import read_dataset
from r37core.base.io import Named, read_json, write_json
from r37core.base.plain import to_plain
from r37core.blade.definition import shape_from_plain
from r37core.config import ConfigError, Settings, operating_range
from r37core.config.changed_numbers import ImpossibleValueError
from r37core.config.settings import judged_region
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

from .designs import NOMINAL, SearchDesigns, choice_of, designs_of
from .problem import START
from .quantity import MINIMISED, DesignStructure, contact_value, static_stress, structure_value

_STRUCTURE = ("geometry", CAMPBELL, "contact_model", "stress_operator")


class Refused(ValueError):
    """A design that cannot be built; the message says why."""


@dataclass(frozen=True)
class DesignRuns:
    """Runs of a design: `structure`, recipes of its own blade, and for each scene the sweeps, that of NOMINAL first."""

    structure: Mapping[str, Recipe]
    scenes: Mapping[str, Mapping[str, BladeSweep]]
    speeds: Mapping[str, SharedSpeeds]
    about: Mapping[str, str]
    density: float


@dataclass(frozen=True)
class Evaluation:
    """Evaluation of the designs of the search of these `settings`, with files in a `folder`, on so many `cores`."""

    settings: Settings
    folder: Path
    run_all: RunAll
    cores: int

    @cached_property
    def _attributes(self) -> Mapping[str, Any]:
        return structure_attributes(self.settings, self._blade)

    @property
    def designs(self) -> SearchDesigns:
        """Designs of the search."""
        return designs_of(self.settings)

    @property
    def _blade(self) -> str:
        return self.designs.entry.blade

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
            made_of = [part.made_of for part in runs.structure.values()] + [code_of("r37studies.search.steps.search")]
            made_of += to_plain([runs.scenes, runs.speeds, choice_of(self.settings).quantities, operating_range(self.settings)])
            (folder := self.folder / name).mkdir(parents=True, exist_ok=True)
            return read_json(kept_file("quantities.json", made_of, partial(self._measure, name, runs, run_all), folder))
        except (ConfigError, ImpossibleValueError, Refused, BucklingError, NoEquilibriumError, NoRoomError) as error:
            return str(error)

    def runs(self, name: str, values: Sequence[float] | None) -> DesignRuns:
        """Runs of a design. Raises ConfigError and ImpossibleValueError for one that is impossible."""
        members, blade = self.designs.members(name, values), self._blade
        nominal = {scene: several[NOMINAL] for scene, several in members.items()}
        first = next(iter(nominal.values()))
        material = first.blades[blade].material
        assert material is not None
        return DesignRuns(
            structure=recipes(first, blade, dict.fromkeys(_STRUCTURE), kept=self._is_start(first)),
            scenes={
                scene: {
                    member: blade_sweep(varied, blade, scene, kept=self._is_start(varied)) for member, varied in several.items()
                }
                for scene, several in members.items()
            },
            speeds={scene: shared_speeds(varied, blade, scene) for scene, varied in nominal.items()},
            about={scene: str(Sweep(varied).provenance(Named(blade=blade, scene=scene))) for scene, varied in nominal.items()},
            density=material.density,
        )

    def _is_start(self, varied: Settings) -> bool:
        """True if the blade has the model of the start, which the user's cache keeps."""
        return varied.blades[self._blade].elastic == self.settings.blades[self._blade].elastic

    def _measure(self, name: str, runs: DesignRuns, run_all: RunAll, file: Path) -> None:
        """Build the design, run it, and write its quantities. Raises Refused where it cannot be built."""
        if name != START and self.designs.change_blade:
            self._check_shape(name, runs)
        made = {stage: part.file(self._structures, self._attributes) for stage, part in runs.structure.items()}
        operating, quantities = operating_range(self.settings), choice_of(self.settings).quantities
        highest = self.settings.structure.maximum_speed_rad_s
        speeds = {quantity.speed or highest for quantity in quantities.values()}
        stiffening = read_contact_model(made["contact_model"]).rotation_stiffening
        operator = judged_operator(read_stress_operators(made["stress_operator"]))
        structure = DesignStructure(
            volume=float(read_dataset(made["geometry"])["volume"]),
            density=runs.density,
            campbell=read_dataset(made[CAMPBELL]),
            static_stress=static_stress(operator, stiffening, sorted(speeds)),
        )
        nominal, members = {}, {}
        for scene, sweeps in runs.scenes.items():
            driver = Driver(self.folder / name / scene, self._structures, self._attributes, run_all)
            about = dict.fromkeys(sweeps, runs.about[scene])
            first, *others = driver.run(sweeps, runs.speeds[scene], made[CAMPBELL], about).values()
            nominal[scene] = robustness(read_judged(first), operating=operating)
            members[scene] = [
                robustness(member, chance_scatter=False, operating=operating) for member in map(read_judged, others)
            ]
        values = {
            name: contact_value(quantity, nominal, members)
            if quantity.measure in MINIMISED
            else (structure_value(quantity, structure, highest), 0.0)
            for name, quantity in quantities.items()
        }
        known = {name: [number if math.isfinite(number) else None for number in value] for name, value in values.items()}
        write_json(known, file)

    def _check_shape(self, name: str, runs: DesignRuns) -> None:
        """Raise Refused for a shape that cannot be built or meshed, or has no elements where the stress is judged."""
        # gmsh takes a second to load, which rounds have no use for
        from r37core.fem.mesh_quality import check_quality, mesh_quality
        from r37core.mesh.generate import generate_mesh

        level = self.settings.fidelity.mesh
        region = judged_region(self.settings, self._blade)
        try:
            shape = shape_from_plain(runs.structure["geometry"].params["definition"])
            blade = shape.build(round_edges=self.settings.structure.edges == "round")
            mesh = generate_mesh(blade, level.nodes, level.layers, level.tip_elements)
            check_quality(mesh, mesh_quality(mesh), level.minimum_scaled_jacobian)
            # elements next to contact nodes, which are known with the model, count here
            if not region.elements(mesh, np.empty(0, dtype=int)):
                raise ValueError(f"the stress region ({region.description()}) has no elements")
        except ValueError as error:
            raise Refused(str(error)) from None
