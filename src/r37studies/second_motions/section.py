"""second_motions of config.yaml: motions that a start from rest does not show."""

from itertools import product

from r37core.config import Settings, blades_named, scenes_named
from r37core.config.declaring import declared_by, si_form
from r37core.config.section import AllOrNames, ExtensionSection, Section, option, refused

from .choice import STEP, SweepChoice

_FIRST, _LAST = ("from_rad_s", "from_rpm"), ("to_rad_s", "to_rpm")


@declared_by(SweepChoice)
class SecondMotionSection(Section):
    """Sweeps up and down; none without speeds."""

    refuse_several = (_FIRST, _LAST, ("step_rad_s", "step_rpm"))

    blades: AllOrNames = option("Blades that are swept", "all")
    scenes: AllOrNames = option("Scenes that are swept; by default those without a rotor", "all")

    def _check(self) -> None:
        if self.model_dump(exclude_defaults=True) and len(self.end_keys) < 2:
            value = f"{self.end_keys[0]} alone" if self.asked else "no speeds"
            raise refused(value, "from_rad_s and to_rad_s, or from_rpm and to_rpm")
        if self.asked and self.sweep().last < self.sweep().first:
            allowed = "a higher one; both sweeps go through the same speeds"
            raise refused("a speed below the lowest one", allowed, self.end_keys[1])

    @property
    def asked(self) -> bool:
        """True if there is something to sweep."""
        return bool(self.end_keys)

    @property
    def end_keys(self) -> list[str]:
        """Keys of the lowest and of the highest speed."""
        return [key for key in _FIRST + _LAST if getattr(self, key) is not None]

    def sweep(self) -> SweepChoice:
        """The sweeps that are asked for."""
        has_step = self.step_rad_s is not None or self.step_rpm is not None
        return si_form(SweepChoice, self, **({} if has_step else {"step": STEP}))


SECTION = ExtensionSection(
    "second_motions",
    SecondMotionSection,
    option("Sweeps up and down the speeds, whose motions may differ from those from rest", SecondMotionSection()),
)


def pairs_of(settings: Settings) -> list[tuple[str, str]]:
    """Pairs of blade and scene that are swept; of all scenes those without a rotor."""
    section, single = settings.section(SECTION), [name for name, each in settings.scenes.items() if each.scene.rotor is None]
    if not section.asked:
        return []
    blades = [name for name in blades_named(settings, section.blades) if name in settings.blade_names]
    return list(product(blades, [name for name in scenes_named(settings, section.scenes) if name in single]))
