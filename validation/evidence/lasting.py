"""How long an interaction lasts: runs of several lengths about it."""

from typing import Any

import numpy as np

from r37core.figures.style import PAGE, plt, save
from r37core.results.measures import motion
from r37core.results.ranking import robustness
from r37core.results.regions import read_judged
from r37core.time_integration.settling import MotionAtEnd

<<<<<<< HEAD
=======
from .configuration import settings_of
>>>>>>> aa4f067c (Accuracy and lining are planned as data: levels on all blades with large displacements against a finer reference; large motion against CalculiX)
from .pages import write_table

<<<<<<< HEAD
STATES = (MotionAtEnd.LASTING, MotionAtEnd.GROWING, MotionAtEnd.CUT_FREE, MotionAtEnd.QUIET)
=======
LINED, ABOUT_PEAK = "abradable", (0.97, 1.06)
"""Scene, and shares of a published peak about which it is looked for."""

SPEEDS = np.arange(1660.0, 1770.1, 2.0)
"""(rad/s) About 1B/4."""

LENGTHS, UNTIL_SETTLED, MOST = (200, 1000, 5000), "until settled", 5000
"""Revolutions of runs, and the most until settled."""

RISE = 40.0
"""Revolutions in which the lobes rise, whatever the length of a run: the published share of 200."""

STATISTIC = 100
"""Last revolutions whose stress counts, whatever the length of a run."""

STEP, FACTOR, BESIDE = 4.0, 20.0, 0.01
"""Step of speeds about a peak (rad/s); thickness that no run wears through, over the shipped one; share beside a found one."""


@dataclass(frozen=True)
class Length:
    """Length of a run: its name, revolutions, and whether it ends when settled."""

    name: str
    revolutions: int
    until_settled: bool = False


RUNS = (*(Length(f"{number:,}", number) for number in LENGTHS), Length(UNTIL_SETTLED, MOST, until_settled=True))
THICKNESS_RUNS = (RUNS[0], RUNS[-1])


def _run(
    settings: Settings, contact: ContactModel, scene: Scene, speed: float, length: Length, stress: StressOperator | None = None
) -> dict[str, Any]:
    shipped = settings.integration_choice(REFERENCE, LINED, speed)
    snapshots = 0 if stress is None else STATISTIC
    choice = replace(
        shipped, revolutions=length.revolutions, until_settled=length.until_settled, snapshot_revolutions=snapshots
    )
    results = ("wear",) if stress is None else ("stress", "wear")
    return run_speed(
        contact, speed, scene, choice, results, spectrum_highest_order=1, wear_angles=8, stress=stress and {"judged": stress}
    )


def runs(input: Any, output: Any, params: Any) -> None:
    """Runs of all RUNS at SPEEDS. Input: contact, stress, of the reference blade on points."""
    settings, models = settings_of(Path.cwd()), Models.read(input.contact, input.stress)
    shipped, limit = settings.scenes[LINED].scene, settings.blades[REFERENCE].material.yield_stress
    scene, rows = replace(shipped, casing=replace(shipped.casing, rise_revolutions=RISE)), []
    for speed in map(float, SPEEDS):
        for length in RUNS:
            run = _run(settings, models.contact, scene, speed, length, models.stress)
            last = stress_statistic(run["revolution_von_mises"][0, -STATISTIC:], limit)
            rows.append(
                {
                    "speed": speed,
                    "length": length.name,
                    "revolutions": int(run["statistic_end"]),
                    "motion_at_end": MotionAtEnd(int(run["motion_at_end"])).text,
                    "rms": float(np.hypot(*run["rms"][0, [0, 2]])),
                    "above": bool(last["share_of_revolutions_above_yield"] > 0.5),
                    "worn_through": bool(run["worn_through_share"] > 0.0),
                }
            )
    with atomic_write(output[0]) as new:
        pd.DataFrame(rows).to_csv(new, index=False, float_format="%.8g")
>>>>>>> aa4f067c (Accuracy and lining are planned as data: levels on all blades with large displacements against a finer reference; large motion against CalculiX)


def lasting(input: Any, output: Any, params: Any) -> None:
    """Table by length of a run, and curves of rms. Input: runs (responses). Params: revolutions. Outputs: table, picture."""
    rows, (figure, axes) = [], plt.subplots(figsize=(PAGE, 2.8))
    for file, revolutions, marker in zip(input.runs, params.revolutions, "oxv", strict=True):
        response = read_judged(file)
        length = robustness(response, chance_scatter=False)["length_most_revolutions_rad_s"]
        counts = [np.count_nonzero(response["motion_at_end"] == state) for state in STATES]
        rows.append([revolutions, f"{length:.0f}", *map(str, counts)])
        axes.plot(response["speed"], 1e3 * motion(response), f"{marker}-", markersize=3, label=revolutions)
    states = [state.text.replace("_", " ") for state in STATES]
    write_table(["revolutions", "above yield (rad/s)", *(f"{state}: runs" for state in states)], rows, output.table)
    axes.set_xlabel("speed (rad/s)")
    axes.set_ylabel("rms of the leading edge (mm)")
    axes.legend(title="revolutions")
    save(figure, output.picture)
