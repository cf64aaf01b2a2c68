"""Runs of ours about the published interactions, with the stress of every revolution at some speeds."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import xarray as xr
from published import DIRECT_PEAK, INTERACTIONS, QUIET, REFERENCE

from r37core.base.dataset_file import read_dataset
from r37core.base.plain import from_plain
from r37core.config import Settings
from r37core.contact.scene import Scene
from r37core.results.measures import peak_of
from r37core.rom.reduced_model import contact_model
from r37core.rom.rom_file import read_reduced_model
from r37core.time_integration.speed_run import run_speed

from .configuration import settings_of
from .paper_box import BOX, box_operator, box_part
from .published_windows import BARE, DIRECT, LINED, bare, narrow, paper_window, window

Runs = Mapping[str, xr.Dataset]

SPEEDS = (DIRECT_PEAK, INTERACTIONS[0].peak, QUIET)
"""Speeds (rad/s) at which the paper shows the reference blade's stress of every revolution."""


def responses_of(files: Iterable[str]) -> dict[tuple[str, bool], xr.Dataset]:
    """Responses by blade and whether there is a lining, with all their speeds."""
    responses = (box_part(read_dataset(file)) for file in files)
    return {(response.attrs["blade"], bool(response["lined"])): response for response in responses}


def level_runs(files: Sequence[str], models: Sequence[str], level: str) -> dict[str, xr.Dataset]:
    """Runs of `paper` or `standard`, with stress histories at the published speeds and at each blade's own peak."""
    about = paper_window if level == "paper" else window
    responses = responses_of(files)
    runs = {row.name: at(responses[row.blade, True], about(row)) for row in INTERACTIONS}
    runs[BARE] = at(responses[REFERENCE, False], bare(2.0))
    return with_histories(runs, models, settings_of(Path.cwd(), fidelity=level), peaks=True)


def choice_runs(files: Sequence[str], models: Sequence[str]) -> dict[str, xr.Dataset]:
    """Runs of a choice at level `standard`, about the published peaks."""
    responses = responses_of(files)
    runs = {row.name: at(responses[row.blade, True], narrow(row)) for row in INTERACTIONS}
    if direct := responses.get((REFERENCE, False)):
        runs[BARE] = at(direct, bare(4.0))
    return with_histories(runs, models, settings_of(Path.cwd()), peaks=False)


def at(response: xr.Dataset, speeds: Iterable[float]) -> xr.Dataset:
    """The response at those of the speeds (rad/s) that were run."""
    return response.sel(speed=[speed for speed in speeds if speed in response["speed"]])


def with_histories(runs: Runs, models: Sequence[str], settings: Settings, *, peaks: bool) -> dict[str, xr.Dataset]:
    """Runs with the stress of every revolution; `peaks`: also at the largest motion of each window with lining."""
    files, several = {Path(file).parent.name: file for file in models}, dict(runs)
    for name, run in runs.items():
        speeds = {*SPEEDS} if name in (INTERACTIONS[0].name, BARE) else set()
        if peaks and name != BARE:
            speeds.add(float(peak_of(run)["speed"]))
        if speeds:
            stress = [history(settings, files[run.attrs["blade"]], run, speed) for speed in sorted(speeds)]
            kept = run.drop_dims("history_speed", errors="ignore").assign_coords(history_speed=sorted(speeds))
            several[name] = kept.assign(max_von_mises_history=(("history_speed", "revolution"), np.array(stress)))
    return several


def history(settings: Settings, rom: str, response: xr.Dataset, speed: float) -> np.ndarray:
    """Largest stress (Pa) of every revolution in the scene of a response, shape (revolutions,)."""
    scene = from_plain(Scene, json.loads(response.attrs["scene_parameters"]))
    model, blade = read_reduced_model(rom), response.attrs["blade"]
    choice = settings.integration_choice(blade, LINED if scene.lining else DIRECT)
    run = run_speed(
        contact_model(model, Path(rom).stem.removeprefix("rom_")),
        speed,
        scene,
        replace(choice, snapshot_revolutions=choice.revolutions),
        ["stress"],
        spectrum_highest_order=1,
        wear_angles=8,
        stress={BOX: box_operator(model, settings.blades[blade].material)},
    )
    return run["revolution_von_mises"][0]
