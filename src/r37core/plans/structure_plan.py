"""The plan of the structural half: what the rules from shape to Campbell diagram compute with."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from r37core.config import Settings


@dataclass(frozen=True)
class Structure:
    """Numbers of the rules from shape to Campbell diagram. Methods with `wildcards` are parameters of rules."""

    settings: Settings

    def definition(self, wildcards: Any) -> Any:
        """Shape of a blade, which Snakemake does not compare."""
        return self.settings.blades[wildcards.blade].definition

    def shape_hash(self, wildcards: Any) -> str:
        """Hash of the shape, which re-runs a job when it changes."""
        return self.settings.shape_hash(wildcards.blade)

    def material(self, wildcards: Any) -> dict[str, float]:
        """Material of a blade; empty for one of matrices."""
        material = self.settings.blades[wildcards.blade].material
        return asdict(material) if material else {}

    def elastic(self, wildcards: Any) -> dict[str, float]:
        """Material of a blade with what stiffness and mass depend on: a new yield stress asks for no new matrices."""
        return {name: value for name, value in self.material(wildcards).items() if name != "yield_stress"}

    @property
    def base_reduction(self) -> dict[str, Any]:
        """What reduced models are made of, with contact nodes as config.yaml has them."""
        return asdict(self.settings.reduction_choice())

    def reduction(self, wildcards: Any) -> dict[str, Any]:
        """What the reduced model is made of, with contact nodes on the line that the wildcard names."""
        return asdict(self.settings.reduction_choice(wildcards.tip_line, wildcards.blade))
