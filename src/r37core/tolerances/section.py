"""tolerances of config.yaml: numbers that are never known exactly."""

from __future__ import annotations

from pydantic import Field

from r37core.config.section import AllOrNames, Section
from r37core.config.spread import MemberCount, Spread, SpreadEntry


class ToleranceSection(Section):
    """Numbers that spread, and how many members are drawn of them; without any there are none."""

    of_scenes: dict[str, SpreadEntry] = Field(
        default={}, description="by dotted keys of scenes.yaml, such as lining.elastic_modulus_pa"
    )
    of_blades: dict[str, SpreadEntry] = Field(
        default={},
        description="by material.<key>, sweep_percent and lean_percent of the table, sweep_cm and lean_deg added at the tip "
        "(in proportion to the span), stagger_deg, camber_deg, chord_percent and thickness_percent of all profiles, also with "
        ".hub or .tip",
    )
    members: MemberCount = Field(default=32, description="a power of two; more of them change none that are there")
    seed: int = Field(default=0, ge=0, le=2**31, description="another one gives another sample")
    sensitivity: bool = Field(
        default=False, description="Sobol indices, which take as many members again for each number, and once more"
    )
    blades: AllOrNames = Field(default="all", description="of those that are run")
    scenes: AllOrNames = Field(default="all", description="of those that are run")
    largest_share: float = Field(
        default=0.2, ge=1e-3, le=1, description="of the finest grid of adaptive speeds that is run at most, by every member"
    )

    @property
    def spreads(self) -> dict[tuple[str, str], Spread]:
        """Section and key of each number -> how it spreads, in the order of the sample."""
        return {
            (section, key): entry.spread()
            for section in ("of_blades", "of_scenes")
            for key, entry in getattr(self, section).items()
        }
