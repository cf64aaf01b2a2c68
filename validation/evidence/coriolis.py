"""The Coriolis force: what it changes at interactions. Each run is made with it and without it, from the same model."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from published import INTERACTIONS

from r37core.config import Settings
from r37core.results.campbell import campbell_diagram
from r37core.rom.contact_model import ContactModel
from r37core.rom.reduced_model import ReducedModel, contact_model
from r37core.rom.rom_file import read_reduced_model
from r37core.time_integration.speed_run import run_speed

from .configuration import settings_of
from .tables import write_table

LINED, BARE = "abradable", "direct"
ABOUT = np.arange(-12.0, 19.0)
"""Speeds (rad/s) about a published peak."""

SPREAD = ABOUT[::3]
"""Speeds (rad/s) about it of the means on the bare casing."""


def peaks(input: Any, output: Any, params: Any) -> None:
    """Table of peaks on the lining, and of means on the bare casing, without the force and with it. Input: models."""
    settings = settings_of(Path.cwd())
    models = {Path(file).parent.name: read_reduced_model(file) for file in input.models}
    rows = []
    for interaction in (row for row in INTERACTIONS if row.blade in models):
        model = models[interaction.blade]
        both = (replace(model, coriolis=None), model)
        contacts = [contact_model(each, settings.structure.boundary.tip_line) for each in both]
        crossings = [_crossing(each, interaction.engine_order) for each in both]
        centre = round(interaction.peak)
        lined, bare = (
            np.array(
                [[_motion(settings, interaction.blade, contact, scene, speed) for speed in speeds] for contact in contacts]
            )
            for scene, speeds in ((LINED, centre + ABOUT), (BARE, centre + SPREAD))
        )
        highest, means = lined.argmax(axis=1), bare.mean(axis=1)
        rows.append(
            [
                interaction.label,
                f"{crossings[1] - crossings[0]:+.1f}",
                f"{centre + ABOUT[highest[0]]:.0f}",
                f"{ABOUT[highest[1]] - ABOUT[highest[0]]:+.0f}",
                f"{100.0 * (lined[1].max() / lined[0].max() - 1.0):+.1f}%",
                f"{100.0 * (means[1] / means[0] - 1.0):+.1f}%",
            ]
        )
    head = ["interaction", "change of crossing (rad/s)", "peak without (rad/s)", "change of peak (rad/s)"]
    write_table([*head, "change of its rms", "bare casing: change of mean rms"], rows, output.table)


def _motion(settings: Settings, blade: str, contact: ContactModel, scene: str, speed: float) -> float:
    """Rms (m) of the leading edge's normal and tangential motion together: S100 hardly moves towards the casing."""
    choice = replace(settings.integration_choice(blade, scene, speed), snapshot_revolutions=0)
    kept = {"spectrum_highest_order": 1, "wear_angles": 8}
    result = run_speed(contact, float(speed), settings.scenes[scene].scene, choice, (), **kept)
    return float(np.hypot(*result["rms"][0, [0, 2]]))


def _crossing(model: ReducedModel, order: int) -> float:
    """Speed (rad/s) at which 1B has the frequency of an engine order."""
    return campbell_diagram(model, np.linspace(0.0, 2000.0, 41), 3).crossing_speeds(np.array([order]))[0, 0]
