"""The plan of the structural half: what the rules from shape to Campbell diagram compute with."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

from r37core.blade.definition import BladeDefinition
from r37core.config import Settings
from r37core.config.settings import location_of_contact
from r37core.plain import to_plain

from .paths import MESH, WHOLE_BLADE_MODEL, fill
from .provenance import Attributes
from .samples import NOMINAL, Pair, Sample, Samples, folder_and_name, member_of


@dataclass(frozen=True)
class Structure:
    """Numbers of the rules from shape to Campbell diagram, also of samples `beside` the sweep; `wildcards` as of Sweep."""

    settings: Settings
    beside: Mapping[str, Mapping[Pair, Sample]] = field(default_factory=dict)

    @cached_property
    def _samples(self) -> Samples:
        return Samples(self.settings, self.beside)

    def definition(self, wildcards: Any) -> Any:
        """Shape of a blade."""
        definition, (folder, name) = self._samples.blade(wildcards).definition, folder_and_name(wildcards)
        if folder and isinstance(definition, BladeDefinition):
            # the name is for messages
            definition = replace(definition, name=f"{wildcards.blade}, {f'member {name} of ' if name else ''}{folder}")
        return to_plain(definition)

    def mesh(self, wildcards: Any) -> str:
        """The mesh of a blade: the nominal one where the shape is."""
        nominal = self.settings.blades[wildcards.blade].definition == self._samples.blade(wildcards).definition
        return fill(MESH, member=NOMINAL if nominal else wildcards.member, blade=wildcards.blade)

    def material(self, wildcards: Any) -> dict[str, float] | None:
        """Material of a blade; None for one of matrices."""
        return to_plain(self._samples.blade(wildcards).material)

    def elastic(self, wildcards: Any) -> dict[str, float]:
        """Material of a blade with a mesh, as if it never yielded."""
        return to_plain(self._samples.blade(wildcards).elastic.material)

    def base_reduction(self, wildcards: Any) -> dict[str, Any]:
        """What a blade's reduced model is made of, with contact nodes as config.yaml has them."""
        return to_plain(self.settings.reduction_choice(wildcards.blade))

    def kept(self, wildcards: Any) -> bool:
        """Whether the user's cache keeps a blade's reduced model: those of members are used once."""
        return member_of(wildcards) == NOMINAL

    def location_of_contact(self, wildcards: Any) -> Attributes:
        """Where stands what a blade's contact acts on; another line re-runs nothing."""
        return Attributes(location=location_of_contact(self.settings, wildcards.blade))

    def reduction(self, wildcards: Any) -> dict[str, Any]:
        """What the reduced model is made of, with contact nodes on the line that the wildcard names."""
        return to_plain(self.settings.reduction_choice(wildcards.blade, wildcards.tip_line))

    def whole_blade_model(self, wildcards: Any) -> str:
        """The model that recovers the whole blade, with the contact nodes of a scene, or else those of config.yaml."""
        scene = getattr(wildcards, "scene", None)
        tip_line = self.settings.scenes[scene].tip_line if scene else self.settings.structure.boundary.tip_line
        return fill(WHOLE_BLADE_MODEL, blade=wildcards.blade, tip_line=tip_line)

    def whole_blade_reduction(self, wildcards: Any) -> dict[str, Any]:
        """What that model is made of: the sweep's, recovered everywhere."""
        choice = self.settings.reduction_choice(wildcards.blade, wildcards.tip_line)
        return to_plain(replace(choice, recover_whole_blade=True))
