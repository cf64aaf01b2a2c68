"""A flexible casing: what rings of two thicknesses, on stiff and soft flanges, change for the seven blades, and their cost."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from published import INTERACTIONS

from r37core.config.declaring import si_form
from r37core.contact.elastic_casing import ElasticCasing
from r37core.contact.ring import Ring, RingMode
from r37core.contact.scene import Scene
from r37core.rom.contact_model import ContactModel, read_contact_model
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.speed_run import run_speed

from .configuration import settings_of
from .pages import write_table

LINING, BARE = "elastic_abradable", "elastic_direct"
SCENES = {LINING: "abradable lining", BARE: "bare casing"}
STIFF, SOFT = 1e9, 1e7
"""Stiffness of the flanges, radial and tangential, per length of circumference (N/m2)."""

Casing = tuple[float, float] | None
"""Thickness of the ring (m) and stiffness of its flanges; None is a rigid casing."""

RINGS: tuple[tuple[float, float], ...] = tuple((thickness, flanges) for flanges in (STIFF, SOFT) for thickness in (2e-3, 1e-3))
CASINGS: tuple[Casing, ...] = (None, *RINGS)
FASTEST = 2000.0
"""The benchmark's highest speed (rad/s)."""

SPAN, STEP = 30.0, 2.0
"""Speeds, in rad/s, about a published peak, and from one to the next."""

SHARES = np.linspace(0.98, 1.06, 9)
"""Speeds on the bare casing, as shares of the published peak of 1B with engine order 4."""

NEAR = 10.0
"""Speeds, in rad/s, on either side of a peak of which none may diverge."""

DIAMETERS = (5, 10, 20, 40)
TIMED, ROUNDS = np.arange(800.0, 2000.0, 200.0), 3


class Runs:
    """Runs of the seven blades in the shipped scenes, with other rings; `files`: contact models of the blades."""

    def __init__(self, files: Sequence[str]):
        self.settings = settings_of(Path.cwd(), scenes=list(SCENES))
        self._contacts = {Path(file).parent.name: read_contact_model(file) for file in files}

    @property
    def blades(self) -> list[str]:
        """Blades with a model."""
        return list(self._contacts)

    def contact(self, blade: str) -> ContactModel:
        """Contact model of a blade."""
        return self._contacts[blade]

    def casing(self, casing: tuple[float, float], diameters: int = 20) -> ElasticCasing:
        """The shipped ring with another thickness, other flanges, and modes up to some nodal diameters."""
        thickness, flanges = casing
        shipped = si_form(Ring, self.settings.scene_designs.entries[LINING].casing.ring)
        other = {"thickness": thickness, "radial_foundation": flanges, "tangential_foundation": flanges}
        ring = replace(shipped, **other, highest_nodal_diameter=diameters)
        return ElasticCasing(ring.modes(), ring)

    def modes(self, casing: Casing, diameters: int = 20) -> tuple[RingMode, ...]:
        """Modes of a casing; none of a rigid one."""
        return () if casing is None else self.casing(casing, diameters).modes

    def scene(self, name: str, modes: tuple[RingMode, ...]) -> Scene:
        """A shipped scene with other modes of the casing."""
        scene = self.settings.scenes[name].scene
        return replace(scene, casing=replace(scene.casing, ring=modes))

    def rms(self, blade: str, name: str, speed: float, scene: Scene) -> tuple[float, float, float]:
        """Rms (m) of the leading edge, normal and tangential, and of all waves round the casing."""
        choice = replace(self.settings.integration_choice(blade, name, speed), snapshot_revolutions=0)
        ring = scene.casing.ring
        kept = {"spectrum_highest_order": 20, "wear_angles": 8}
        result = run_speed(self.contact(blade), float(speed), scene, choice, ["casing"] if ring else [], **kept)
        waves = np.sum(result["casing_rms_forward"] ** 2 + result["casing_rms_backward"] ** 2) if ring else 0.0
        normal, tangential = result["rms"][0, [0, 2]]
        return normal, tangential, np.sqrt(waves)

    def motion(self, blade: str, name: str, speeds: Sequence[float], modes: tuple[RingMode, ...]) -> np.ndarray:
        """Rms (m) of normal and tangential motion together at some speeds; NaN where a run diverges."""
        scene = self.scene(name, modes)
        return np.array([np.hypot(*self.rms(blade, name, speed, scene)[:2]) for speed in speeds])


def shown(casing: Casing) -> str:
    """Name of a casing for a reader."""
    return "rigid" if casing is None else f"{1e3 * casing[0]:g} mm, {'stiff' if casing[1] == STIFF else 'soft'}"


def clear_peak(speeds: np.ndarray, rms: np.ndarray) -> int | None:
    """Index of the largest rms over ascending speeds; None where runs near it diverge (NaN).

    Near it are speeds within NEAR, and those down to half its power on either side.
    """
    if np.isnan(rms).all():
        return None
    peak = int(np.nanargmax(rms))
    near = np.abs(speeds - speeds[peak]) <= NEAR
    low = np.flatnonzero(rms < rms[peak] / np.sqrt(2.0))
    first, last = low[low < peak].max(initial=-1), low[low > peak].min(initial=len(rms))
    near[first + 1 : last] = True
    return None if np.isnan(rms[near]).any() else peak


def peak_cell(speeds: np.ndarray, rms: np.ndarray) -> str:
    """Speed (rad/s) and height (mm) of the peak, where there is one, and how many runs diverge."""
    peak, diverged = clear_peak(speeds, rms), int(np.isnan(rms).sum())
    cell = "no peak" if peak is None else f"{speeds[peak]:.0f}, {1e3 * rms[peak]:.2f}"
    at_end = peak in (0, len(speeds) - 1)
    return cell + " at the end" * at_end + f" ({diverged} diverge)" * (diverged > 0)


def peaks(input: Any, output: Any, params: Any) -> None:
    """Table of the peaks of the ten published interactions."""
    runs, rows = Runs(input.files), []
    for row in INTERACTIONS:
        speeds = round(row.peak) + np.arange(-SPAN, SPAN + 0.5 * STEP, STEP)
        cells = [f"{row.blade} 1B/{row.engine_order}", f"{row.peak:g}"]
        cells += [peak_cell(speeds, runs.motion(row.blade, LINING, speeds, runs.modes(casing))) for casing in CASINGS]
        rows.append(cells)
    write_table(["interaction", "published (rad/s)", *map(shown, CASINGS)], rows, output.table)


def bare_casing(input: Any, output: Any, params: Any) -> None:
    """Table of the bare casing about 1B with engine order 4: means over speeds, which move less than single runs."""
    runs, rows = Runs(input.files), []
    for row in (row for row in INTERACTIONS if row.engine_order == 4):
        cells = [f"{row.blade}, {SHARES[0] * row.peak:.0f} to {SHARES[-1] * row.peak:.0f} rad/s"]
        for casing in CASINGS:
            scene = runs.scene(BARE, runs.modes(casing))
            rms = np.array([runs.rms(row.blade, BARE, speed, scene) for speed in SHARES * row.peak])
            diverged = int(np.isnan(rms[:, 0]).sum())
            if diverged == len(rms):
                cells.append("all diverge")
                continue
            means = " / ".join(f"{1e3 * value:.3f}" for value in np.nanmean(rms, axis=0)[: 3 if casing else 2])
            cells.append(means + f" ({diverged} diverge)" * (diverged > 0))
        rows.append(cells)
    write_table(["blade and speeds", *map(shown, CASINGS)], rows, output.table)


def diameters(input: Any, output: Any, params: Any) -> None:
    """Table of the peak of Ref's 1B with engine order 4, with modes up to some nodal diameters."""
    runs, row = Runs(input.files), INTERACTIONS[0]
    speeds = round(row.peak) + np.arange(-SPAN, SPAN + 0.5 * STEP, STEP)
    rows = [
        [
            shown(casing),
            *(peak_cell(speeds, runs.motion(row.blade, LINING, speeds, runs.modes(casing, number))) for number in DIAMETERS),
        ]
        for casing in RINGS[:2]
    ]
    write_table(["ring", *(f"up to n = {number}" for number in DIAMETERS)], rows, output.table)


def cost(input: Any, output: Any, params: Any) -> None:
    """Table of the time of the time integration with a ring as a multiple of that without, in turns in one process."""
    runs, rows = Runs(input.files), []
    for name, scene in SCENES.items():
        for number in (10, 20):
            modes = runs.modes(RINGS[0], number)
            ratios = [_ratio(runs, name, modes, speed) for speed in TIMED for _ in range(ROUNDS)]
            low, middle, high = np.percentile(ratios, [10, 50, 90])
            rows.append([scene, str(number), f"{middle:.2f}", f"{low:.2f} to {high:.2f}"])
    write_table(["scene", "nodal diameters up to", "ratio of CPU times, median", "10% to 90%"], rows, output.table)


def _ratio(runs: Runs, name: str, ring: tuple[RingMode, ...], speed: float) -> float:
    times = []
    for modes in ((), ring):
        choice = replace(runs.settings.integration_choice("Ref", name, speed), snapshot_revolutions=0)
        simulation = Simulation(runs.contact("Ref"), float(speed), runs.scene(name, modes), choice)
        simulation.advance(simulation.start(), 1)
        state, begun = simulation.start(), time.process_time()
        simulation.advance(state, choice.revolutions)
        times.append(time.process_time() - begun)
    return times[1] / times[0]
