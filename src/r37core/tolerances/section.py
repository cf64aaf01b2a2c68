"""tolerances of config.yaml: numbers that are never known exactly."""

from __future__ import annotations

from pydantic import Field

from r37core.config.section import AllOrNames, ExtensionSection
from r37core.config.spread import MemberCount, Spreads


class ToleranceSection(Spreads):
    """Numbers that spread, and how many members are drawn of them; without any there are none."""

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


SECTION = ExtensionSection("tolerances", ToleranceSection, ToleranceSection())
