"""Motions that a start from rest does not show: those of the seven blades, their kinds, Ref's drop, checks of two."""

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from r37core.base.dataset_file import read_dataset
from r37core.contact.scene import Scene
from r37core.results.other_motions import ranking_with_motions
from r37core.rom.contact_model import ContactModel, read_contact_model
from r37core.second_motions.choice import REST, UP, DwellChoice, SweepChoice
from r37core.second_motions.dataset import dwell_dataset
from r37core.second_motions.dwelling import dwells_of
from r37core.second_motions.states import SweptStates, read_states
from r37core.second_motions.sweeping import CarriedSweep
from r37core.second_motions.tables import dwell_table
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.motion_kind import MotionKind, kind_of_motion
from r37core.time_integration.simulate import Simulation

from .configuration import settings_of
from .pages import write_table

CONTACTS = ("points", "patches")
SCENES = {"bare casing": ("direct", "direct"), "lining": ("abradable", "material_abradable")}
"""Name of a scene in the page -> the scene on points and on patches."""

KINDS = ("lasting", "switching", "transient")
EVERY = 5
"""Every so many-th of the speeds of a sweep has its kind of motion measured."""

DROP = tuple(np.arange(1338.0, 1359.0, 2.0))
STEPS = (4.8e-6, 2.4e-6, 1.2e-6)

AGAIN = {"CS100": 1195.0, "S50": 1405.0}
"""Blade -> speed (rad/s) of a second motion that is marched again."""

REVOLUTIONS = 100
WAYS = ("as shipped", "half the step")


def tables(input: Any, output: Any, params: Any) -> None:
    """Second motions of all blades. Inputs: points, patches, ranges, dwells. Outputs: table, ranges, ranking."""
    motions = {contact: read_dataset(getattr(input, contact)) for contact in CONTACTS}
    ranges = {contact: pd.read_csv(file) for contact, file in zip(CONTACTS, input.ranges, strict=True)}
    columns = [(name, contact) for name in SCENES for contact in CONTACTS]
    blades = [str(blade) for blade in motions["points"]["blade"].values]
    rows = []
    for blade in blades:
        cells = []
        for name, contact in columns:
            scene = SCENES[name][CONTACTS.index(contact)]
            table = ranges[contact]
            cells.append(_cell(table[(table["blade"] == blade) & (table["scene"] == scene)], motions[contact]))
        rows.append([blade, *cells])
    write_table(["blade", *(f"{name}, {contact}" for name, contact in columns)], rows, output.table)
    together = pd.concat([table.assign(contact=contact) for contact, table in ranges.items()])
    together.to_csv(output.ranges, index=False, float_format="%.6g")
    write_table(*_ranking(motions["patches"], blades), output.ranking)


def _cell(ranges: pd.DataFrame, motions: xr.Dataset) -> str:
    """Length of the ranges by their kind, its first letter, and the motion that is most above that from rest."""
    above = ranges[ranges["largest_motion"] != REST]
    if above.empty:
        return "none"
    step = float(motions["speed"].diff("speed").min())
    lengths = [(kind, step * above.loc[above["kind"] == kind, "speeds"].sum()) for kind in KINDS]
    several = ", ".join(f"{length:.0f} {kind[0].upper()}" for kind, length in lengths if length)
    strongest = next(above[above["kind"] == kind] for kind in KINDS if (above["kind"] == kind).any())
    ratio = [_size(row, row["largest_motion"]) / _size(row, REST) for _, row in strongest.iterrows()]
    row = strongest.iloc[int(np.argmax(ratio))]
    motion = row["largest_motion"]
    rest, most = (1e3 * row[f"rms_normal_{name}_m"] for name in (REST, motion))
    return f"{several}; {row['speed_rad_s']:.0f}: {rest:.2f}/{most:.2f}"


def _size(row: pd.Series, motion: str) -> float:
    return float(row[f"rms_normal_{motion}_m"])


def _ranking(motions: xr.Dataset, blades: Iterable[str]) -> tuple[list[str], list[list[str]]]:
    """Lengths above yield (place) by the motion from rest and by the worst one, on patches."""
    head, columns = ["blade"], []
    for name, (_, scene) in SCENES.items():
        table = ranking_with_motions(pd.DataFrame({"blade": list(blades), "scene": scene}), motions)
        for motion, words in (("rest", "from rest"), ("worst", "worst motion")):
            length = table[f"length_most_revolutions_{motion}_rad_s"]
            places = length.rank(method="min").astype(int)
            columns.append([f"{value:.0f} ({place})" for value, place in zip(length, places, strict=True)])
            head.append(f"{name}: {words}")
    return head, [[blade, *cells] for blade, *cells in zip(blades, *columns, strict=True)]


def kinds(input: Any, output: Any, params: Any) -> None:
    """Kinds of the motions from rest in the bare casing. Inputs: points, patches (states), models of both. Output: table."""
    settings = settings_of(Path.cwd())
    rows = []
    for place, blade in enumerate(settings.blades):
        cells = []
        for contact in CONTACTS:
            model = read_contact_model(getattr(input, f"{contact}_models")[place])
            states = SweptStates(getattr(input, contact)[place])
            cells += _kinds_of(model, states, *_scene_and_choice(settings, blade))
        rows.append([blade, *cells])
    names = ("chaotic", "periodic", "exponent")
    write_table(["blade", *(f"{contact}: {name}" for contact in CONTACTS for name in names)], rows, output.table)


def _kinds_of(model: ContactModel, states: SweptStates, scene: Scene, choice: IntegrationChoice) -> list[str]:
    measured, exponents = [], []
    for place in range(0, len(states.speeds), EVERY):
        motion = states.motion(place)
        if motion is None:
            continue
        simulation = Simulation(model, float(states.speeds[place]), scene, choice)
        kind = kind_of_motion(simulation, simulation.start(motion))
        measured.append(kind.kind)
        exponents.append(kind.exponent)
    several = [MotionKind.CHAOTIC], [MotionKind.PERIODIC, MotionKind.MULTIPLE]
    shares = [np.mean([kind in those for kind in measured]) for those in several]
    chaotic = [exponent for exponent, kind in zip(exponents, measured, strict=True) if kind is MotionKind.CHAOTIC]
    median = f"{np.median(chaotic):.2f}" if chaotic else ""
    return [*(f"{share:.0%}" for share in shares), median]


def _scene_and_choice(settings: Any, blade: str) -> tuple[Scene, IntegrationChoice]:
    """The bare casing with full-grown lobes, and the time integration with nothing recorded."""
    choice = settings.integration_choice(blade, "direct", 0.0)
    return settings.scenes["direct"].scene.grown, replace(choice, snapshots_per_revolution=0, snapshot_revolutions=0)


def switching(input: Any, output: Any, params: Any) -> None:
    """Ref about its published drop: share of time in the high motion, exponents at three steps. Inputs: model, states."""
    settings, model = settings_of(Path.cwd()), read_contact_model(input.model)
    states = read_states(input.states)
    speeds = states[UP].speeds
    sweep = SweepChoice(float(speeds[0]), float(speeds[-1]), float(speeds[1] - speeds[0]))
    grown, choice = _scene_and_choice(settings, "Ref")
    dwells = DwellChoice(range_speeds=0, speeds=DROP)
    rows = dwells_of(CarriedSweep(model, grown, choice, sweep), states, dwells)
    table = dwell_table(_labelled(dwell_dataset(rows, dwells.revolutions)))
    lines = []
    for _, row in table.iterrows():
        nearest = int(np.argmin(np.abs(speeds - row["speed_rad_s"])))
        exponents = []
        for step in STEPS:
            simulation = Simulation(model, row["speed_rad_s"], grown, replace(choice, time_step=step))
            motion = states[UP].motion(nearest)
            assert motion is not None
            state = simulation.start(motion)
            simulation.advance(state, REVOLUTIONS)
            kind = kind_of_motion(simulation, state)
            exponents.append(f"{kind.exponent:.2f} ± {kind.error:.2f}")
        held = [_revolutions(row[f"{of}_revolutions"]) for of in ("high", "low")]
        lines.append([f"{row['speed_rad_s']:.0f}", f"{row['share_of_time_high']:.0%}", *held, *exponents])
    head = ["speed (rad/s)", "time in the high motion", "high held for (revolutions)", "low held for (revolutions)"]
    write_table([*head, *(f"exponent, step {1e6 * step:g} us" for step in STEPS)], lines, output.table)


def _labelled(dataset: xr.Dataset) -> xr.Dataset:
    labels = {"blade": "Ref", "scene": "direct"}
    return dataset.assign({name: ("dwell", np.full(dataset.sizes["dwell"], label, object)) for name, label in labels.items()})


def _revolutions(number: float) -> str:
    if np.isnan(number):
        return ""
    return "all" if np.isinf(number) else f"{number:.0f}"


def again(input: Any, output: Any, params: Any) -> None:
    """Two second motions with half the step. Inputs: models, states. Output: table."""
    settings, rows = settings_of(Path.cwd()), []
    for place, (name, speed) in enumerate(AGAIN.items()):
        model = read_contact_model(input.models[place])
        grown, choice = _scene_and_choice(settings, name)
        up, rest = (SweptStates(input.states[2 * place + number]) for number in range(2))
        at = int(np.argmin(np.abs(up.speeds - speed)))
        cells = []
        changes = {"as shipped": {}, "half the step": {"time_step": 0.5 * choice.time_step}}
        for states, ways in ((up, WAYS), (rest, WAYS[:1])):
            motion = states.motion(at)
            assert motion is not None
            for way in ways:
                simulation = Simulation(model, speed, grown, replace(choice, **changes[way]))
                state = simulation.start(motion)
                normal = simulation.advance(state, REVOLUTIONS).samples[:, 0]
                cells.append(f"{1e3 * np.sqrt(np.mean(normal[len(normal) // 2 :] ** 2)):.4f}")
        rows.append([f"{name}, {speed:.0f} rad/s", *cells])
    head = [*(f"up: {way}" for way in WAYS), *(f"from rest: {way}" for way in WAYS[:1])]
    write_table(["normal rms (mm)", *head], rows, output.table)
