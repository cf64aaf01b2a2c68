"""tolerances of config.yaml: numbers that are never known exactly."""

from pydantic import Field

from r37core.config.section import AllOrNames, ExtensionSection
from r37core.config.spread import MemberCount, Spreads


class ToleranceSection(Spreads):
    """Distributions of numbers, and the sample drawn from them; both may be empty."""

    members: MemberCount = Field(
        default=32, description="Number of members, a power of two; a larger sample contains the smaller ones"
    )
    seed: int = Field(default=0, ge=0, le=2**31, description="Seed of the sample")
    sensitivity: bool = Field(
        default=False, description="Whether Sobol indices are computed; for n numbers this runs n + 2 times the members"
    )
    blades: AllOrNames = Field(default="all", description="Blades with tolerances")
    scenes: AllOrNames = Field(default="all", description="Scenes with tolerances")
    largest_share: float = Field(
        default=0.2, ge=1e-3, le=1, description="Largest share of the finest grid of adaptive speeds that a member runs"
    )


SECTION = ExtensionSection("tolerances", ToleranceSection, ToleranceSection())
