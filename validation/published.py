"""What the paper publishes about its seven blades (section 7 of the benchmark). Speeds in rad/s. Light."""

from dataclasses import dataclass

REFERENCE = "Ref"


@dataclass(frozen=True)
class PublishedInteraction:
    """An interaction of 1B: Campbell speed, and the speed of the largest rms in the lined scene."""

    blade: str
    engine_order: int
    campbell: float
    peak: float

    @property
    def name(self) -> str:
        """Name in file names."""
        return f"{self.blade}_{self.engine_order}"

    @property
    def label(self) -> str:
        """Name in tables and figures."""
        return f"{self.blade} 1B/{self.engine_order}"


INTERACTIONS = (
    PublishedInteraction("Ref", 4, 1672.0, 1717.0),
    PublishedInteraction("L50", 4, 1621.0, 1672.0),
    PublishedInteraction("L100", 4, 1564.0, 1597.0),
    PublishedInteraction("S50", 4, 1660.0, 1691.0),
    PublishedInteraction("S100", 4, 1635.0, 1642.0),
    PublishedInteraction("CS50", 4, 1532.0, 1589.0),
    PublishedInteraction("CS100", 4, 1362.0, 1407.0),
    PublishedInteraction("Ref", 5, 1213.0, 1264.0),
    PublishedInteraction("Ref", 6, 965.0, 996.0),
    PublishedInteraction("Ref", 7, 806.0, 838.0),
)

BLADES = tuple(row.blade for row in INTERACTIONS if row.engine_order == 4)
VARIANTS = BLADES[1:]

DIRECT_PEAK = 1344.0
"""Speed of direct contact's largest rms; one rad/s above it the response has dropped."""

QUIET = 1800.0
"""Speed at which both scenes stay below yield during the whole run."""

WIDTH_ABOVE_YIELD = 17.0
"""Range of speeds (rad/s) about 1B/4 over which the reference blade's last revolution is above yield."""

FIRST_YIELD = {"lined": 40, "direct": 90}
"""Revolution of the reference blade's first yield: at its 1B/4 peak, and at DIRECT_PEAK (shortly before)."""

VARIANTS_FIRST_YIELD = (44, 78)
"""Earliest and latest first yield of the variants at their peaks."""

FIRST_CONTACT = 7
"""Revolutions before the first contact, about."""

OVERTAKES = 19
"""Revolution at which the lined scene's stress passes direct contact's at the 1B/4 peak, about."""

S100_STRESS_BELOW = 3.0
"""Reference blade's stress at its 1B/4 peak is more than so many times S100's at its own."""

LINING_THICKNESS = 5e-3
"""Wear (m) where the lining is worn through, as it is somewhere at every interaction of the reference blade."""

TORSION = 1630.0
"""About where the lined scene shows a response of the first torsion mode."""

LARGEST_ELSEWHERE = 0.8e-3
"""Nothing but the four interactions has a larger rms (m, of the radial displacement, lined, 750 to 2000 rad/s)."""

MEDIAN = {"lined": 0.02e-3, "direct": 0.13e-3}
"""Median rms (m, of the radial displacement) over 750 to 2000 rad/s."""

AREAS_CM2 = {0: 1.8427, 30: 1.4094, 50: 1.1842, 70: 0.9806, 100: 0.7059}
"""Span (%) -> area of the reference blade's profile."""
VOLUME_CM3 = 8.08

CLEARANCE_SLOPES = {
    "1B": dict(zip(BLADES, (0.215, 0.180, 0.146, 0.109, 0.001, 0.198, 0.196), strict=True)),
    "1T": dict(zip(BLADES, (0.535, 0.498, 0.462, 0.430, 0.351, 0.560, 0.594), strict=True)),
}
"""Change of the clearance per tangential displacement, of a prototype of the benchmark: the paper has curves, no numbers."""
