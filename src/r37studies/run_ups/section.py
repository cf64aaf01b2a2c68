"""run_ups of config.yaml: speeds that change while the blade rubs."""

from typing import Annotated, Any

from pydantic import Field

from r37core.config.declaring import declared_by, si_form
from r37core.config.section import AllOrNames, ExtensionSection, LeftOut, Named, Section, left_out, option, refused

from .choice import Crossing, RunUpChoice

_LENGTH = ("rate_rad_s2", "rate_rpm_s", "revolutions")
Share = Annotated[float, Field(ge=-0.5, le=1)]


@declared_by(Crossing)
class CrossingSection(Section):
    """Speeds about a crossing of each blade's own Campbell diagram."""

    first: Share = option("Start, as a share of the crossing's speed above it")
    last: Share = option("End, as first; below first it is a run-down")


@declared_by(RunUpChoice)
class RunUpEntry(Section):
    """A run-up, or run-down where it ends at the lower speed, of every chosen blade in every chosen scene."""

    one_of = (("from_rad_s", "from_rpm", "crossing"), ("to_rad_s", "to_rpm", "crossing"), _LENGTH)

    blades: AllOrNames = option("Blades of the run-up", "all")
    scenes: AllOrNames = option("Scenes of the run-up", "all")
    crossing: CrossingSection | LeftOut = left_out("Speeds about a crossing, in place of numbers")

    def _check(self) -> None:
        choice = self.choice(1)
        if choice.start == choice.stop and self.revolutions is None:
            raise refused("a rate between equal speeds", "revolutions, for a run at constant speed", self.key_of_length)

    @property
    def key_of_length(self) -> str:
        """The key that says how long it takes."""
        return next(key for key in _LENGTH if getattr(self, key) is not None)

    def choice(self, revolutions_of_scene: int) -> RunUpChoice:
        """Run-up that is asked for in a scene whose runs have so many revolutions."""
        parts: dict[str, Any] = {"before": self.revolutions_before or revolutions_of_scene, "crossing": None}
        if crossing := self.crossing:
            parts |= {"start": crossing.first, "stop": crossing.last, "crossing": si_form(Crossing, crossing)}
        return si_form(RunUpChoice, self, **parts)


SECTION: ExtensionSection[dict[str, RunUpEntry]] = ExtensionSection(
    "run_ups",
    Named[RunUpEntry],  # type: ignore[arg-type]
    option("Run-ups and run-downs by name", {}),
)
