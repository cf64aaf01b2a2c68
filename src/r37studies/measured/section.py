"""measured and calibrate of config.yaml."""

from typing import Annotated, Any, Literal

from pydantic import Field

from r37core.base.io import CarriedError
from r37core.config.blade_sections import Degrees, GaugeEntry
from r37core.config.section import (
    ExtensionSection,
    FileName,
    LeftOut,
    Name,
    Rpm,
    Section,
    Speed,
    either,
    left_out,
    option,
    refused,
)
from r37core.config.spread import Percent, SpreadEntry, Spreads, Width

from .points import STRAIN, TIP_TIMING, WORN_DEPTH

PHASOR = "key_phasor"
"""Column of a key phasor's pulses, one a revolution."""

ASKED = "?"
"""Column that is answered with what the header has."""


class MeasurementSection(Section):
    """A quantity of a blade in a scene as it was measured, one column of a file."""

    refuse_several = (("speed_rad_s", "speed_rpm"),)

    file: FileName = option("CSV with a header that has units: `speed_rpm`, `amplitude (um)`")
    blade: Name = option("Blade that is run")
    scene: Name = option("Scene that is run")
    quantity: Literal[
        "displacement_normal", "displacement_tangential", "displacement_radial", "strain", "tip_timing", "worn_depth"
    ] = option("What was measured: a displacement of the tip, strain of a gauge, displacement by tip timing, or worn depth")
    statistic: Literal["rms", "half_peak_to_peak", "order"] = option(
        "Statistic of the values; of a time signal amplitudes of its engine orders", "rms"
    )
    engine_order: Annotated[int, Field(ge=1, le=1000)] | LeftOut = left_out("Engine order, with statistic: order")
    tip_point: Literal["leading_edge", "trailing_edge"] = option("End of the tip", "leading_edge")
    gauge: either(Name, GaugeEntry) | LeftOut = left_out(  # type: ignore[valid-type]
        "Gauge of a strain: its place, or its name under signals.gauges"
    )
    probe_deg: Degrees | LeftOut = left_out("Casing angle of the tip-timing probe, towards growing theta")
    value: str | LeftOut = left_out("Column with the values, where several may be; ? lists the columns")
    uncertainty: str | LeftOut = left_out("Column with standard deviations, where several may be")
    uncertainty_percent: Percent | LeftOut = left_out("Standard deviation of each value")
    speed_rad_s: Speed | LeftOut = left_out("Speed, where the file has none: of a curve, a time signal or a spectrum")
    speed_rpm: Rpm | LeftOut = left_out("The same speed in revolutions per minute")
    columns: dict[Literal["speed", "angle", "time", "key_phasor"], str] = option(
        "Columns of these, where several may be; key_phasor has a pulse each revolution, beside times", {}
    )
    sweep: Literal["up", "down"] | LeftOut = left_out("Which of two sweeps of the speed in one file")
    rows: dict[str, str] = option("Rows of a long file that count: text by column", {})
    speed_of: Literal["values", "peak", "first_above"] = option(
        "In place of the values the speed of the largest, or the first speed above a limit", "values"
    )
    limit: Width | LeftOut = left_out("Limit of first_above in SI units")
    gain: SpreadEntry | LeftOut = left_out("Distribution of measured over true values, as of a gauge factor, that a fit takes")

    def _check(self) -> None:
        for key, owner, needing in (
            ("gauge", self.quantity, STRAIN),
            ("probe_deg", self.quantity, TIP_TIMING),
            ("engine_order", f"statistic {self.statistic}", "statistic order"),
        ):
            if (getattr(self, key) is not None) != (needed := owner == needing):
                joint, allowed = ("without", "beside it") if needed else ("with", "left out")
                raise refused(f"{owner} {joint} {key}", f"{key} {allowed}", key)
        if self.quantity in (TIP_TIMING, WORN_DEPTH) and self.statistic == "order":
            raise refused(f"order of {self.quantity}", "another statistic", "statistic")
        if (self.limit is None) == (self.speed_of == "first_above"):
            raise refused(f"{self.speed_of} {'without' if self.limit is None else 'with'} a limit", "both or none", "limit")


class MeasurementError(CarriedError):
    """A file of a measurement that cannot be used, for a reason that `key` of its entry is to blame for."""

    def __init__(self, key: str, text: str):
        super().__init__(text)
        self.key = key


class CalibrateSection(Spreads):
    """Numbers that are fitted to the measurements, with what is known of them before."""

    runs: int = option("Number of designs: sets of values that are simulated", 48, ge=8, le=2000)
    first: int = option("Number of first designs, evenly spread", 16, ge=4, le=2000)
    batch: int = option("Number of designs per round, run in parallel", 4, ge=1, le=500)
    draws: int = option("Number of draws of the result, for tolerances.drawn_file", 256, ge=32, le=4096)
    seed: int = option("Seed of designs and draws", 0, ge=0, le=2**31)
    frequencies_percent: SpreadEntry | LeftOut = left_out("Natural frequencies at rest, in percent of the model's")

    def _check(self) -> None:
        if not self.spreads:
            raise refused("no number", "some under of_scenes or of_blades, each with its range")
        if 2 * self.first > self.runs:
            # designs of later rounds say how wrong the surrogates are
            raise refused(f"{self.first}", f"at most half of runs ({self.runs})", "first")


MEASURED: ExtensionSection[Any] = ExtensionSection(
    "measured", list[MeasurementSection], option("Measurements beside the simulation (docs/measurement.md)", [])
)
CALIBRATE: ExtensionSection[CalibrateSection | None] = ExtensionSection(
    "calibrate",
    CalibrateSection | LeftOut,  # type: ignore[arg-type]
    left_out("Numbers fitted to the measurements (docs/measurement.md)"),
)
