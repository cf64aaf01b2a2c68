"""run_ups of config.yaml: speeds that change while the blade rubs."""

from __future__ import annotations

import math
from typing import Annotated, Literal

from pydantic import Field, model_validator

from r37core.run_ups.schedule import RunUp

from .section import AllOrNames, LeftOut, Rpm, Section, Speed, refused
from .si_fields import si_fields

_START, _STOP = ("from_rad_s", "from_rpm"), ("to_rad_s", "to_rpm")
_LENGTH = ("rate_rad_s2", "rate_rpm_s", "revolutions")
_SHORTEST, _LONGEST = 1e-3, 100_000


class RunUpEntry(Section):
    """One run-up, or run-down where it ends at the lower speed, of every chosen blade in every chosen scene."""

    blades: AllOrNames = Field(default="all", description="of those that are run")
    scenes: AllOrNames = Field(default="all", description="of those that are run")
    from_rad_s: Speed | LeftOut = Field(
        default=None, description="speed at which it begins, and at which the casing becomes lobed"
    )
    from_rpm: Rpm | LeftOut = None
    to_rad_s: Speed | LeftOut = Field(default=None, description="speed at which it ends; a lower one is a run-down")
    to_rpm: Rpm | LeftOut = None
    rate_rad_s2: Annotated[float, Field(gt=0, le=1e9)] | LeftOut = Field(
        default=None, description="change of the speed per second, of a run-down too; or rate_rpm_s; or revolutions"
    )
    rate_rpm_s: Annotated[float, Field(gt=0, le=1e10)] | LeftOut = None
    revolutions: Annotated[float, Field(ge=_SHORTEST, le=_LONGEST)] | LeftOut = Field(
        default=None, description="revolutions that the change takes, in place of a rate"
    )
    revolutions_before: Annotated[int, Field(ge=1, le=20000)] | LeftOut = Field(
        default=None, description="at the first speed, in which the casing becomes lobed; without it those of the scene"
    )
    revolutions_after: int = Field(default=0, ge=0, le=20000, description="at the last speed")
    lining: Literal["new", "worn"] = Field(default="new", description="worn: by the same run-up, done once before")

    @model_validator(mode="after")
    def _complete(self) -> RunUpEntry:
        for keys in (_START, _STOP, _LENGTH):
            given = [key for key in keys if getattr(self, key) is not None]
            if len(given) != 1:
                at = (given[1],) if given else (keys[0],)
                raise refused(at, " and ".join(given) if given else "nothing", f"one of {', '.join(keys)}")
        fields = si_fields(self)
        squares = abs(fields["to"] ** 2 - fields["from"] ** 2)
        if squares == 0.0 and self.revolutions is None:
            raise refused((self.key_of_length,), "a rate between equal speeds", "revolutions, for a run at constant speed")
        if not _SHORTEST <= self.run_up(1).revolutions <= _LONGEST:
            slowest, fastest = (squares / (4.0 * math.pi * number) for number in (_LONGEST, _SHORTEST))
            raise refused(
                (self.key_of_length,),
                f"a run-up of {self.run_up(1).revolutions:.4g} revolutions",
                f"{_SHORTEST:g} to {_LONGEST:g} of them: rates from {slowest:.3g} to {fastest:.3g} rad/s2",
            )
        return self

    @property
    def key_of_length(self) -> str:
        """The key that says how long it takes."""
        return next(key for key in _LENGTH if getattr(self, key) is not None)

    def run_up(self, revolutions_of_scene: int) -> RunUp:
        """The run-up in a scene whose runs have so many revolutions."""
        fields = si_fields(self)
        start, stop = fields["from"], fields["to"]
        revolutions = self.revolutions
        if revolutions is None:
            revolutions = abs(stop**2 - start**2) / (4.0 * math.pi * fields["rate"])
        before = self.revolutions_before or revolutions_of_scene
        return RunUp(start, stop, revolutions, before, self.revolutions_after, worn=self.lining == "worn")
