"""Equal blades of a rotor against a single one: passing the lining one by one, and on one grid of time."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from published import REFERENCE

from r37core.contact.ring import RingMode
from r37core.contact.scene import Rotor, Scene
from r37core.rom.contact_model import ContactModel, read_contact_model
from r37core.time_integration.compiled.engine import advance_in_lockstep
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.problem import stable_problem
from r37core.time_integration.rotor_blades import turned
from r37core.time_integration.rotor_simulation import RotorSimulation
from r37core.time_integration.simulate import Simulation

from .configuration import settings_of
from .pages import write_table

LINED = "abradable"
SPEED, BLADES = 1700.0, 36
"""(rad/s), number."""

STIFF = RingMode(0, 1e5, 1e6, 0.01)
"""A mode of an elastic casing that hardly moves."""

ANGLES = tuple(2.0 * np.pi * np.arange(BLADES) / BLADES)


def rms(samples: np.ndarray) -> float:
    """Tangential rms (m) of the leading edge over the second half of the samples, shape (samples, directions of points)."""
    return float(np.sqrt(np.mean(samples[len(samples) // 2 :, 2] ** 2)))


def rotor_rms(model: ContactModel, scene: Scene, choice: IntegrationChoice, elastic: bool = False) -> list[float]:
    """Rms (m) of each of BLADES: in a rigid casing they pass one by one, in an elastic one step by step."""
    places = tuple(range(1, BLADES + 1))
    rotor = Rotor(places, ANGLES, (1.0,) * BLADES, (0.0,) * BLADES, True)
    casing = replace(scene.casing, ring=(STIFF,)) if elastic else scene.casing
    run = RotorSimulation(model, SPEED, replace(scene, casing=casing, rotor=rotor), choice).run()
    return [rms(part.samples) for part in run.records]


def lockstep_rms(model: ContactModel, scene: Scene, choice: IntegrationChoice) -> list[float]:
    """Rms (m) of each of BLADES that go step by step in a rigid casing."""
    problems = [stable_problem(turned(model, angle), SPEED, scene, choice) for angle in ANGLES]
    blades = [Simulation.build(problem) for problem in problems]
    states = [blade.start() for blade in blades]
    for state in states[1:]:
        state.wear = states[0].wear
    outs = [blade.room(0, choice.revolutions * choice.samples_per_revolution) for blade in blades]
    advance_in_lockstep([blade.engine for blade in blades], states, outs, list(range(BLADES)))
    return [rms(out.samples) for out in outs]


def grid(input: Any, output: Any, params: Any) -> None:
    """Tangential rms of a single blade and of rotors, at 1B/4. Input: contact, of the reference blade on points."""
    settings, model = settings_of(Path.cwd()), read_contact_model(input.contact)
    scene, shipped = settings.scenes[LINED].scene, settings.integration_choice(REFERENCE, LINED, SPEED)
    whole = replace(shipped, snapshot_revolutions=0)
    found: dict[str, dict[str, list[float]]] = {}
    for words, share in {"shipped step": 1.0, "half the step": 0.5}.items():
        choice = replace(whole, time_step=share * whole.time_step)
        single = Simulation(model, SPEED, scene, choice).run()
        found[words] = {
            "one blade": [rms(single.records[0].samples)],
            f"{BLADES} blades, one by one": rotor_rms(model, scene, choice),
            f"{BLADES} on one grid of time": lockstep_rms(model, scene, choice),
            f"{BLADES} on one grid, in a stiff ring": rotor_rms(model, scene, choice, elastic=True),
        }
    write_rows(found, output.table)


def write_rows(found: dict[str, dict[str, list[float]]], file: Path | str) -> None:
    """Table of the least and largest rms (m) of the blades; a column for each step."""
    rows = [[what, *(_cell(columns[what]) for columns in found.values())] for what in next(iter(found.values()))]
    write_table(["blades", *(f"{words}: rms (mm)" for words in found)], rows, file)


def _cell(values: list[float]) -> str:
    least, largest = (f"{1e3 * end:.4f}" for end in (min(values), max(values)))
    return least if least == largest else f"{least} to {largest}"
