"""The plan of the tolerances: members of samples, each with runs of its own, and what is made of them together."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import Any

from r37core.blade.definition import BladeDefinition
from r37core.config import BladeSettings
from r37core.config.members import Member
from r37core.plain import to_plain
from r37core.speeds import exact_text
from r37core.tolerances.sample import is_of_sample

from . import paths
from .provenance import Attributes, Provenance
from .sweep_plan import Sweep, asked_by, speeds_of_rounds

_KEPT = ("spectrum", "stress", "static_stress")
"""Results of a scene that its members have, too: what ranges are read off."""


@dataclass(frozen=True)
class Tolerances:
    """Plan of the members that the configuration asks for. Methods with `wildcards` are inputs and parameters of rules.

    `round_file(blade=..., scene=..., round=...)`: as of Sweep, of the rounds that all members of a blade and scene share.
    """

    sweep: Sweep
    made: Provenance
    round_file: Callable[..., str] | None = None

    @property
    def pairs(self) -> list[tuple[str, str]]:
        """Blades and scenes with members."""
        return self.sweep.settings.members.pairs

    def names(self, blade: str, scene: str) -> list[str]:
        """Members of a blade and scene: the sample first, then what sensitivity indices need beside it."""
        return list(self.sweep.settings.members.all[blade, scene])

    def _sample(self, blade: str, scene: str) -> list[str]:
        """Members of the sample: they alone say where speeds are adaptive, so that indices change none."""
        return [name for name in self.names(blade, scene) if is_of_sample(name)]

    def _member(self, wildcards: Any) -> Member:
        return self.sweep.settings.members.all[wildcards.blade, wildcards.scene][wildcards.member]

    @cached_property
    def _blades(self) -> dict[str, dict[str, BladeSettings]]:
        """Blades of the members, by nominal blade and member, as if they never yielded."""
        found: dict[str, dict[str, BladeSettings]] = {}
        for (blade, _), members in self.sweep.settings.members.all.items():
            found.setdefault(blade, {}).update({name: member.blade.elastic for name, member in members.items()})
        return found

    @cached_property
    def _models(self) -> dict[str, dict[str, str | None]]:
        """Which member's model each member has, by blade: the first of those with the same blade; None for the nominal one."""
        found = {}
        for blade, members in self._blades.items():
            first: dict[BladeSettings, str | None] = {self.sweep.settings.blades[blade].elastic: None}
            found[blade] = {name: first.setdefault(of, name) for name, of in members.items()}
        return found

    def model_file(self, blade: str, member: str, pattern: str) -> str:
        """A file of the model that a member is run with; `pattern`: that of the nominal blade."""
        model = self._models[blade][member]
        return paths.fill(pattern, blade=blade) if model is None else paths.fill(of_member(pattern), blade=blade, member=model)

    def mesh(self, wildcards: Any) -> str:
        """The mesh of a member's blade: the nominal one where its shape is, too."""
        same = self._blades[wildcards.blade][wildcards.member].definition == self._nominal(wildcards).definition
        return paths.fill(paths.MESH if same else of_member(paths.MESH), **wildcards)

    def definition(self, wildcards: Any) -> dict[str, Any]:
        """Shape of a member's blade."""
        definition = self._blades[wildcards.blade][wildcards.member].definition
        assert isinstance(definition, BladeDefinition)
        # the name is for messages
        return to_plain(replace(definition, name=f"{wildcards.blade}, member {wildcards.member} of tolerances"))

    def elastic(self, wildcards: Any) -> dict[str, Any]:
        """Material of a member's blade as if it never yielded."""
        return to_plain(self._blades[wildcards.blade][wildcards.member].material)

    def yield_stress(self, wildcards: Any) -> float:
        """Of a member's blade (Pa)."""
        return self._member(wildcards).blade.yield_stress

    def _nominal(self, wildcards: Any) -> BladeSettings:
        return self.sweep.settings.blades[wildcards.blade]

    def models(self, wildcards: Any) -> list[str]:
        """What the simulations of a member start from, and the operator of the stress, where that is wanted."""
        wanted = [paths.CONTACT_MODEL, *([paths.STRESS_OPERATOR] if self.sweep.with_stress(wildcards) else [])]
        return [self._of_tip_line(wildcards, wildcards.member, pattern) for pattern in wanted]

    def _of_tip_line(self, wildcards: Any, member: str, pattern: str) -> str:
        line = self.sweep.settings.scenes[wildcards.scene].tip_line
        return self.model_file(wildcards.blade, member, pattern.replace("{tip_line}", line))

    def task(self, wildcards: Any) -> str:
        """What one simulation of a member does, as JSON text."""
        results = [result for result in self.sweep.results(wildcards) if result in _KEPT]
        return self._task(wildcards, float(wildcards.speed), results=results, kept=self.sweep.kept)

    def preparation(self, wildcards: Any) -> str:
        """The same of a job that only looks whether a member can be run."""
        return self._task(wildcards, self.sweep.settings.structure.maximum_speed_rad_s, only_prepare=True)

    def _task(self, wildcards: Any, speed: float, **other: Any) -> str:
        choice = self.sweep.settings.integration_choice(wildcards.blade, wildcards.scene, speed)
        # no history of the whole run, which the nominal one may keep
        choice = replace(choice, snapshot_revolutions=min(choice.snapshot_revolutions, choice.revolutions_in_statistic))
        return json.dumps({"scene": to_plain(self._member(wildcards).scene), "choice": to_plain(choice), **other})

    def about_run(self, wildcards: Any) -> Attributes:
        """Attributes of the files of a member's runs."""
        scene = json.dumps(to_plain(self._member(wildcards).scene))
        return Attributes(self.made.sweep(wildcards), member=wildcards.member, scene_parameters=scene)

    def about_model(self, wildcards: Any) -> Attributes:
        """Attributes of the files of a member's model."""
        return Attributes(self.made.structure(wildcards), member=wildcards.member)

    def speed_files(self, wildcards: Any) -> list[str]:
        """The simulations of one member, by ascending speed."""
        speeds = speeds_of_rounds(self.sweep.speed_plan(wildcards), partial(self._asked, wildcards))
        return [paths.fill(paths.MEMBER_SPEED, **wildcards, speed=exact_text(speed)) for speed in speeds]

    def _asked(self, wildcards: Any, number: int) -> list[float]:
        assert self.round_file is not None
        return asked_by(self.round_file(blade=wildcards.blade, scene=wildcards.scene, round=number))

    def round_inputs(self, wildcards: Any) -> dict[str, Any]:
        """What a round looks at: the Campbell diagram, or what all members gave at the speeds of the round before it.

        Their files are member by member.
        """
        number, of = int(wildcards.round), {"blade": wildcards.blade, "scene": wildcards.scene}
        if number == 0:
            return {"campbell": paths.fill(paths.CAMPBELL, blade=wildcards.blade)}
        new, names = self._asked(wildcards, number - 1), self._sample(**of)
        files = [paths.fill(paths.MEMBER_SPEED, **of, member=name, speed=exact_text(speed)) for name in names for speed in new]
        return {"before": paths.fill(paths.MEMBER_ROUND, **of, round=number - 1), "speeds": files}

    def yields_of_round(self, wildcards: Any) -> list[float]:
        """Yield stress (Pa) of each member of the sample."""
        pair = (wildcards.blade, wildcards.scene)
        members = self.sweep.settings.members.all[pair]
        return [members[name].blade.yield_stress for name in self._sample(*pair)]

    def refinement_choice(self, wildcards: Any) -> dict[str, Any]:
        """As of the sweep, with the share of the grid that all members may be run at."""
        return self.sweep.refinement_choice(wildcards) | {"largest_share": self.sweep.settings.config.tolerances.largest_share}

    @property
    def files(self) -> paths.Wildcards:
        """Blade, scene and member of all responses, in the order of the dataset."""
        return [
            {"blade": blade, "scene": scene, "member": name} for blade, scene in self.pairs for name in self.names(blade, scene)
        ]

    @property
    def files_of_sample(self) -> paths.Wildcards:
        """Those of the samples, without members for sensitivity indices alone."""
        return [one for one in self.files if is_of_sample(one["member"])]

    @property
    def campbells_of_sample(self) -> list[str]:
        """The Campbell diagram of each of them."""
        return [self.model_file(one["blade"], one["member"], paths.CAMPBELL) for one in self.files_of_sample]

    @property
    def nominal(self) -> dict[str, list[str]]:
        """Responses and Campbell diagrams of the nominal runs."""
        runs, blades = paths.of_runs(self.pairs), paths.of("blade", [blade for blade, _ in self.pairs])
        return {"nominal": paths.filled({paths.RESPONSE: runs}), "nominal_campbells": paths.filled({paths.CAMPBELL: blades})}

    @property
    def first_rounds(self) -> list[str]:
        """First rounds of the members and of the nominal runs beside them: as of Sweep."""
        adaptive = [pair for pair in self.pairs if self.sweep.settings.speed_plans[pair].refined]
        rounds = [{**one, "round": "0"} for one in paths.of_runs(adaptive)]
        return paths.filled({paths.MEMBER_ROUND: rounds, paths.ROUND: rounds})

    @property
    def numbers(self) -> list[str]:
        """Keys of the numbers that vary."""
        return [key for _, key in self.sweep.settings.members.numbers]

    @property
    def values(self) -> list[list[float | None]]:
        """Of each of the files, in the units of the keys."""
        every = self.sweep.settings.members.all
        return [list(every[one["blade"], one["scene"]][one["member"]].values) for one in self.files]


def of_member(pattern: str) -> str:
    """Where a file of a blade lies for a member with a model of its own."""
    return pattern.replace("<results>/{blade}", paths.MEMBER_MODELS)
