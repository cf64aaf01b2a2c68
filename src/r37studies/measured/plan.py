"""The plan of measurements and of a calibration: what is checked first, what is run, and where it lies."""

from r37core.base.varied_number import BLADE
from r37core.config import ConfigError, Settings
from r37core.config.changed_numbers import ImpossibleValueError
from r37core.plans import paths
from r37core.plans.extension import Extension, Figure
from r37core.plans.extent import Pair, Runs
from r37core.plans.sweep_plan import Sweep
from r37studies.surrogate.gaussian_processes import SearchPackageMissing, library

from .calibration_plan import Calibrated
from .measurement_plan import Measured
from .points import STRAIN
from .section import CALIBRATE, MEASURED

OBSERVED = "<results>/{blade}/{scene}/observed.json"
TABLE = "<results>/measured.csv"
DATASET, NUMBERS = "<results>/calibration.nc", "<results>/calibration.csv"
FOLDER = "<results>/calibrate/fitted"
"""Folder of the draws, and of scenes with the best values."""


def can_be_compared(settings: Settings) -> None:
    """Files of measurements can be read, and are of blades and scenes that are run."""
    _ = settings.made(Measured).all


def can_be_calibrated(settings: Settings) -> None:
    """There are measurements, the numbers are there and possible over their ranges, and the library is installed."""
    if settings.section(CALIBRATE) is None:
        return
    document, calibrated, measured = settings.document, settings.made(Calibrated), settings.made(Measured)
    if not settings.section(MEASURED):
        raise document.refusal("no measurement", "measured: with a file beside it", CALIBRATE.name)
    has_gauge = any(each.quantity == STRAIN for each in measured.all.values())
    if has_gauge and any(number.kind == BLADE for number in calibrated.spreads):
        raise document.refusal("numbers of blades with a gauge", "of_scenes, or no gauge", CALIBRATE.name, "of_blades")
    for (number, spread), value in zip(calibrated.spreads.items(), calibrated.nominal, strict=True):
        try:
            for end in spread.ends(value):
                for pair in measured.pairs:
                    calibrated.changed(*pair, {number: end})
        except (ConfigError, ImpossibleValueError) as error:
            path = (CALIBRATE.name, number.section, number.key)
            raise document.error(path, f"at the end of its range: {error}; or a narrower range") from None
    with document.blamed((CALIBRATE.name,), SearchPackageMissing):
        library()


def simulations(settings: Settings) -> dict[Pair, Runs]:
    """Simulations at each measured speed, by blade and scene: with two frictions, and of the designs of a calibration."""
    measured, number = settings.made(Measured), 2
    if settings.section(CALIBRATE) is not None:
        number += settings.made(Calibrated).section.runs
    several = {pair: measured.pair_measurements(pair).values() for pair in measured.pairs}
    return {pair: Runs(number * len({speed for each in own for speed in each.run_speeds})) for pair, own in several.items()}


def _once(sweep: Sweep) -> paths.Wildcards:
    return [{}] if sweep.settings.section(CALIBRATE) else []


def _pairs(sweep: Sweep) -> paths.Wildcards:
    return paths.run_keys(sweep.settings.made(Measured).pairs)


MEASUREMENTS = Extension(
    name="measured",
    section=MEASURED,
    checks=(can_be_compared,),
    runs=simulations,
    targets=lambda sweep: {OBSERVED: _pairs(sweep), TABLE: [{}] if _pairs(sweep) else []},
    offers={"measured": TABLE},
    figures=(
        Figure(
            rule="measured_figure",
            name="measured_{blade}__{scene}",
            runs=_pairs,
            draw="r37studies.measured.figures.draw_measured",
            files={"table": TABLE},
            offered=("members",),
            label="measurement",
            caption="Blade {blade} in scene {scene}: measured values with two standard deviations, and what simulations of "
            "the same speeds give, with theirs by mesh, step and 0.1% of friction.",
        ),
    ),
    closing="r37studies.measured.closing_lines.closing",
)
CALIBRATION = Extension(
    name="calibrate",
    section=CALIBRATE,
    checks=(can_be_calibrated,),
    targets=lambda sweep: dict.fromkeys((DATASET, NUMBERS, FOLDER), _once(sweep)),
    figures=(
        Figure(
            rule="calibration_figure",
            name="calibration",
            runs=_once,
            draw="r37studies.measured.figures.draw_calibration",
            files={"calibration": DATASET},
            label="calibration",
            caption="Left: each number over its distribution before, 0 to 1; thick line and thin line: 68 and 95% of what the "
            "measurements leave possible, point: best. Right: each measured point and the simulated range.",
            category="Calibration",
        ),
    ),
    closing="r37studies.measured.closing_lines.closing_of_calibration",
)
EXTENSIONS = (MEASUREMENTS, CALIBRATION)
