"""The plan of the second motions: of which blades and scenes, from what, and which files are made of them."""

from collections.abc import Iterable, Iterator
from typing import Any

from r37core.base.speeds import rounded
from r37core.base.yaml_file import KeyPath
from r37core.config import Settings, scenes_named
from r37core.config.cross_checks import names_are_there, slow_run_can_be_done
from r37core.config.settings import length_of_run
from r37core.plans import paths
from r37core.plans.extension import AddedColumns, Extension, Figure
from r37core.plans.extent import Pair, Runs
from r37core.plans.sweep_plan import Sweep
from r37core.time_integration.speed_run import OF_RUNS

from .choice import MOTIONS, REST
from .columns import WORST_MOTION
from .section import SECTION, SecondMotionSection, pairs_of

RESPONSE = "<results>/{blade}/{scene}/second_motions_{motion}.nc"
LEVELS = "<results>/{blade}/{scene}/second_motions_{motion}.npz"
DATASET, TABLE = "<results>/second_motions.nc", "<results>/second_motions.csv"

KEPT = ("stress", "static_stress", "wear", "energy", "casing", "motion_kind")
"""Results of a scene that carried sweeps keep, too."""


def motion_keys(pairs: Iterable[tuple[str, str]]) -> paths.Wildcards:
    """Wildcards of the sweeps of some pairs of blade and scene, one pair after another."""
    return [{**key, "motion": motion} for key in paths.run_keys(pairs) for motion in MOTIONS]


def finished_runs(sweep: Sweep, wildcards: Any) -> list[str]:
    """Files of the pipeline's runs that the motion from rest takes; none of carried motions or worn linings."""
    section = sweep.settings.section(SECTION)
    if not section.asked or wildcards.motion != REST or section.sweep().worn:
        return []
    # the same speeds given in rpm differ in their last digits
    certain = {rounded(speed): speed for speed in sweep.speed_plan(wildcards).certain}
    return paths.speed_files(wildcards, [certain[speed] for speed in section.sweep().speeds if speed in certain])


def results(sweep: Sweep, wildcards: Any) -> list[str]:
    """Results of a sweep: from rest those of the pipeline's simulations."""
    return [each for each in sweep.results(wildcards) if each in (OF_RUNS if wildcards.motion == REST else KEPT)]


def targets(sweep: Sweep) -> dict[str, paths.Wildcards]:
    """The sweeps, and what is made of them."""
    pairs = pairs_of(sweep.settings)
    own: dict[str, paths.Wildcards] = dict.fromkeys((RESPONSE, LEVELS), motion_keys(pairs))
    return own | dict.fromkeys((DATASET, TABLE), [{}] if pairs else [])


MOST_SPEEDS = 20_000
"""Speeds of a sweep: one job has all of them."""


def can_be_swept(settings: Settings) -> None:
    """Blades and scenes are there, without rotor, and the speeds within the model's and not too many."""
    section, path = settings.section(SECTION), ("second_motions",)
    if not section.asked:
        return
    names_are_there(settings, path, section)
    for key, value, allowed in _refusals(settings, section):
        raise settings.document.refusal(value, allowed, *path, *key)
    sweep, scenes = section.sweep(), dict.fromkeys(scene for _, scene in pairs_of(settings))
    lengths = {name: max(sweep.revolutions or 0, settings.scenes[name].revolutions) for name in scenes}
    runs = [length_of_run(settings, name, sweep.first, revolutions) for name, revolutions in lengths.items()]
    if runs:
        slow_run_can_be_done(max(runs, key=lambda run: run.steps), settings, (*path, section.end_keys[0]))


def _refusals(settings: Settings, section: SecondMotionSection) -> Iterator[tuple[KeyPath, str, str]]:
    """Key, value and allowed values of what cannot be swept."""
    sweep, highest = section.sweep(), settings.structure.maximum_speed_rad_s
    (first_key, last_key), scenes = section.end_keys, settings.scene_designs.entries
    for scene in [] if section.scenes == "all" else scenes_named(settings, section.scenes):
        if scenes[scene].rotor is not None:
            yield ("scenes",), f"'{scene}', which has a rotor", "scenes of a single blade"
        if sweep.worn and scene in settings.scenes and not settings.scenes[scene].scene.lined:
            yield ("lining",), f"worn in the scene '{scene}', which has no lining", "new"
    count = (sweep.last - sweep.first) / sweep.step + 1.0
    if count > MOST_SPEEDS:
        yield (), f"{count:.8g} speeds", f"at most {MOST_SPEEDS}; a larger step has fewer"
    if sweep.first < sweep.step:
        allowed = f"from the step on, {sweep.step:g}: the motion is carried on to the next speed"
        yield (first_key,), f"{sweep.first:g} rad/s", allowed
    if sweep.speeds[-1] > highest:
        yield (last_key,), f"{sweep.speeds[-1]:g} rad/s", f"up to structure.maximum_speed_rad_s, {highest:g}"


def further_runs(settings: Settings) -> dict[Pair, Runs]:
    """Sweeps of each blade and scene."""
    section, runs = settings.section(SECTION), {}
    for blade, scene in pairs_of(settings):
        sweep, usual = section.sweep(), settings.scenes[scene].revolutions
        known = set(map(rounded, settings.speed_plans[blade, scene].certain)) & set(sweep.speeds)
        number = len(MOTIONS) * len(sweep.speeds) - len(known)
        runs[blade, scene] = Runs(number, length=number * (sweep.revolutions or usual) / usual)
    return runs


def remarks(settings: Settings) -> list[str]:
    """How long carried motions are, where those from rest have another length."""
    section = settings.section(SECTION)
    carried = section.sweep().revolutions if section.asked else None
    rest = ", ".join(map(str, {settings.scenes[scene].revolutions for _, scene in pairs_of(settings)} - {carried}))
    return [f"second_motions: {carried} revolutions of carried motions, {rest} from rest"] if carried and rest else []


EXTENSION = Extension(
    name="second_motions",
    section=SECTION,
    checks=(can_be_swept,),
    runs=further_runs,
    targets=targets,
    columns=(AddedColumns("ranking", DATASET, "r37studies.second_motions.added.ranking_with_motions", WORST_MOTION),),
    offers={"motions": DATASET},
    figures=(
        Figure(
            rule="second_motions_figure",
            name="second_motions_{blade}__{scene}",
            runs=lambda sweep: paths.run_keys(pairs_of(sweep.settings)),
            draw="r37studies.second_motions.figures.draw_second_motions",
            files={"motions": DATASET},
            label="second motions",
            caption="Blade {blade} in scene {scene}, carried up and down the speeds, and from rest. Motion of the leading "
            "edge, normal and tangential together, with its scatter over the revolutions. Shaded: the motions differ by more "
            "than they scatter. Below: stress, median to largest.",
        ),
    ),
    remarks=remarks,
    closing="r37studies.second_motions.tables.closing",
    look_at=TABLE,
)
