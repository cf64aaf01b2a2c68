"""The plan of the datasets over all blades and scenes: which runs they are joined of, and what is drawn from them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from r37core.config.remarks import elastic_casings
from r37core.plain import to_plain

from . import paths
from .sweep_plan import Sweep


@dataclass(frozen=True)
class Datasets:
    """Plan of what is joined of the runs of a sweep; methods with `wildcards` as of Sweep."""

    sweep: Sweep

    def runs(self, wildcards: Any) -> list[tuple[str, str]]:
        """Pairs of blade and scene in one dataset."""
        return self.sweep.runs_with(wildcards.kind)

    def responses(self, wildcards: Any) -> list[str]:
        """What one dataset is joined of."""
        return [paths.fill(paths.RESPONSE, blade=blade, scene=scene) for blade, scene in self.runs(wildcards)]

    @property
    def casings(self) -> dict[str, Any]:
        """The casing of each scene with a flexible one, as plain values."""
        return {name: to_plain(casing) for name, casing in elastic_casings(self.sweep.settings).items()}

    def response_pictured(self, wildcards: Any) -> dict[str, str]:
        """Datasets that a blade's response is drawn from."""
        return _drawn(with_stress=any(blade == wildcards.blade for blade, _ in self.sweep.runs_with("stress")))

    def compared(self, wildcards: Any) -> dict[str, str]:
        """Datasets that the blades of a scene are compared by."""
        return _drawn(with_stress=any(scene == wildcards.scene for _, scene in self.sweep.runs_with("stress")))


def _drawn(with_stress: bool) -> dict[str, str]:
    return {kind: f"<results>/{kind}.nc" for kind in ("campbell", "rms", *(["stress"] if with_stress else []))}
