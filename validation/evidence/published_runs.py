"""Runs of ours about the published interactions, from files of the product, with the stress of every revolution."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from published import DIRECT_PEAK, INTERACTIONS, QUIET, REFERENCE, PublishedInteraction

from r37core.base.dataset_file import read_dataset
from r37core.base.io import atomic_write
from r37core.base.plain import from_plain
from r37core.contact.scene import Scene
from r37core.results.measures import peak_of
from r37core.rom.reduced_model import contact_model
from r37core.rom.rom_file import read_reduced_model
from r37core.time_integration.speed_run import run_speed

from .configuration import settings_of
from .paper_box import BOX, box_operator, box_part
from .published_windows import BARE, DIRECT, LINED, Source, direct_speeds, histories_of, source

Runs = Mapping[str, xr.Dataset]

SPEEDS = (DIRECT_PEAK, INTERACTIONS[0].peak, QUIET)
"""Speeds (rad/s) at which the paper shows the reference blade's stress of every revolution in both scenes."""


def swept(files: Iterable[str], group: str | None = None) -> dict[tuple[str, bool], xr.Dataset]:
    """Responses by blade and whether there is a lining, with all their speeds."""
    responses = (box_part(read_dataset(file, group=group)) for file in files)
    return {(response.attrs["blade"], bool(response["lined"])): response for response in responses}


def in_windows(
    responses: Mapping[tuple[str, bool], xr.Dataset], of: Callable[[PublishedInteraction], list[float]], step: float
) -> dict[str, xr.Dataset]:
    """Responses at the speeds of the windows `of`, by window; `step` (rad/s): of direct contact about its peak."""
    runs = {row.name: at(responses[row.blade, True], of(row)) for row in INTERACTIONS}
    if bare := responses.get((REFERENCE, False)):
        runs[BARE] = at(bare, direct_speeds(step))
    return runs


def at(response: xr.Dataset, speeds: Iterable[float]) -> xr.Dataset:
    """The response at those of the speeds (rad/s) that were run."""
    return response.sel(speed=[speed for speed in speeds if speed in response["speed"]])


def history(settings: Any, rom: str, response: xr.Dataset, speed: float) -> np.ndarray:
    """Largest stress (Pa) of every revolution at a speed (rad/s), of the scene of a response, shape (revolutions,)."""
    return stress_of_run(settings, rom, response, speed, {})["revolution_von_mises"]


def stress_of_run(settings: Any, rom: str, response: xr.Dataset, speed: float, changes: Mapping[str, Any]) -> dict[str, Any]:
    """Numbers of a run of its own at a speed (rad/s), in the scene of a response; `changes` of the time integration."""
    scene = from_plain(Scene, json.loads(response.attrs["scene_parameters"]))
    model, blade = read_reduced_model(rom), response.attrs["blade"]
    contact = contact_model(model, Path(rom).stem.removeprefix("rom_"))
    choice = settings.integration_choice(blade, LINED if scene.lining else DIRECT, speed)
    changes = {"snapshot_revolutions": choice.revolutions, **changes}
    operator = box_operator(model, settings.blades[blade].material)
    wanted = {"spectrum_highest_order": 1, "wear_angles": 8, "stress": {BOX: operator}}
    numbers = run_speed(contact, speed, scene, replace(choice, **changes), ["stress"], **wanted)
    return numbers | {"operator": operator, "revolution_von_mises": numbers["revolution_von_mises"][0]}


def histories(input: Any, output: Any, params: Any) -> None:
    """Stress of every revolution at the published speeds and, where a source asks for it, at each blade's own peak.

    Output: file, arrays named by window and speed. Params: of, the name of a source.
    """
    chosen = source(params.of)
    models = {Path(file).parent.name: file for file in chosen.models}
    settings, found = settings_of(Path.cwd(), fidelity=chosen.level), {}
    for window, run in _runs(chosen).items():
        speeds = {*SPEEDS} if window in (INTERACTIONS[0].name, BARE) else set()
        if chosen.peaks and window != BARE:
            speeds.add(float(peak_of(run)["speed"]))
        for speed in sorted(speeds):
            found[f"{window} {speed:g}"] = history(settings, models[run.attrs["blade"]], run, speed)
    with atomic_write(output.file) as new, open(new, "wb") as stream:
        np.savez(stream, **found)


def runs_of(name: str) -> dict[str, xr.Dataset]:
    """Runs of a source in its windows, with the stress of every revolution at some speeds."""
    runs = _runs(source(name))
    with np.load(histories_of(name)) as found:
        for window, run in runs.items():
            speeds = [key.split()[1] for key in found if key.split()[0] == window]
            if speeds:
                stress = np.array([found[f"{window} {speed}"] for speed in speeds])
                run = run.assign_coords(history_speed=[float(speed) for speed in speeds], revolution=run["revolution"])
                runs[window] = run.assign(max_von_mises_history=(("history_speed", "revolution"), stress))
    return runs


def _runs(chosen: Source) -> dict[str, xr.Dataset]:
    return in_windows(swept(chosen.responses, chosen.group), chosen.windows, chosen.step)
