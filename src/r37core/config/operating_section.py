"""operating of config.yaml: the range of speeds that an engine flies in."""

from __future__ import annotations

from pydantic import model_validator
from pydantic.fields import Field

from r37core.results.operating_range import OperatingDwell, OperatingRange

from .declaring import declared_by, si_form
from .section import Section, refused


def _one_of_each(section: Section, names: tuple[str, str]) -> tuple[str, str]:
    """Keys that give two speeds. Raises the error of a speed that is not there, or in two units."""
    keys = []
    for name in names:
        both = (f"{name}_rad_s", f"{name}_rpm")
        present = [key for key in both if getattr(section, key) is not None]
        if len(present) != 1:
            raise refused((present[1],) if present else (), " and ".join(present) or f"no {name}", " or ".join(both))
        keys += present
    return keys[0], keys[1]


@declared_by(OperatingDwell)
class OperatingDwellSection(Section):
    """A share of the operating time that is spent between two speeds."""

    @model_validator(mode="after")
    def _ascends(self) -> OperatingDwellSection:
        _, last_key = _one_of_each(self, ("from", "to"))
        dwell = si_form(OperatingDwell, self)
        if dwell.stop <= dwell.start:
            raise refused((last_key,), f"{getattr(self, last_key):g}", "a speed above the lowest one")
        return self


@declared_by(OperatingRange)
class OperatingSection(Section):
    """The speeds from idle to redline."""

    dwell: list[OperatingDwellSection] = Field(
        default=[], description="Speeds at which more time is spent; the rest of it is spread evenly over the range"
    )

    @model_validator(mode="after")
    def _complete(self) -> OperatingSection:
        _, last_key = _one_of_each(self, ("idle", "redline"))
        operating = self.operating()
        if operating.redline <= operating.idle:
            raise refused((last_key,), f"{getattr(self, last_key):g}", f"a speed above idle ({operating.idle:.6g} rad/s)")
        for number, dwell in enumerate(operating.dwell):
            if dwell.start < operating.idle or dwell.stop > operating.redline:
                between = f"between idle and redline, {operating.idle:.6g} and {operating.redline:.6g} rad/s"
                raise refused(("dwell", number), f"{dwell.start:.6g} to {dwell.stop:.6g} rad/s", between)
        total = sum(dwell.share for dwell in operating.dwell)
        if total > 1.0 + 1e-9:
            raise refused(("dwell",), f"{100.0 * total:g} percent of the time", "at most 100 percent together")
        return self

    def operating(self) -> OperatingRange:
        """The range in SI units."""
        return si_form(OperatingRange, self, dwell=tuple(si_form(OperatingDwell, dwell) for dwell in self.dwell))
