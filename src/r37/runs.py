"""The one door to runs of the workflow: any blades, scenes, speeds and sections of the configuration."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Mapping, Sequence
from itertools import count
from pathlib import Path
from typing import Any

from r37core.base.io import temporary_folder, write_text
from r37core.base.yaml_file import yaml_text
from r37core.config import ConfigError, read_document
from r37core.config.messages import single_line
from r37core.config.section import Without
from r37core.product.extensions import EXTENSIONS

from .arguments import Speeds, plain_value, speed_keys
from .call_settings import Call, OneOptions, above, base_of, call_of, chosen_blade, several
from .choices import BladeChoice, SceneChoice, scenes_named
from .jobs import check_cores
from .run_results import RunResults
from .stages import checked_call
from .study_folder import add_workflow
from .workflow_process import run_workflow, snakemake_targets

Blades = BladeChoice | str | Sequence[BladeChoice | str]
Scenes = SceneChoice | str | Sequence[SceneChoice | str]


class RunOptions(OneOptions, total=False):
    """Options of every call of many runs; see `run`."""

    cores: int
    folder: Path | str | None


class SweepOptions(RunOptions, total=False):
    """Options of a call of many runs with speeds."""

    speeds_rpm: Speeds | None


@checked_call
def run(
    blades: Blades | None = None,
    scenes: Scenes | None = None,
    speeds: Speeds | None = None,
    *,
    speeds_rpm: Speeds | None = None,
    fidelity: str | None = None,
    results: Sequence[str] | None = None,
    config: Path | str | None = None,
    cores: int = 1,
    folder: Path | str | None = None,
    targets: str | Sequence[str] | None = None,
    **sections: Any,
) -> RunResults:
    """Run of the workflow: all results of a configuration, as datasets and tables.

    Args:
        blades, scenes: Names, or the results of `r37.blade` and `r37.scene`; changed ones need a `name`. By default those
            of the configuration.
        speeds: As of `r37.sweep`. By default those of the configuration.
        config: A config.yaml in place of the shipped one. All of it counts that no other argument replaces.
        targets: Rules or files, as Snakemake takes them: `"all_blades"` draws all figures, `["tables", "exports"]` writes
            more. By default the tables, and what `sections` ask for that is made on request alone: exports, tradeoff,
            stability, estimate.
        **sections: Sections of config.yaml by name, in the units of their keys, also those of extensions:
            `tolerances={"of_scenes": {"friction.coefficient": {"uniform_percent": 5}}}`.

    Returns:
        As of `r37.open_results`.

    Examples:
        >>> results = r37.run("Ref", "abradable", [1150, 1550], fidelity="draft", interactions={"prominence": 0.3})
        >>> results["rms"].speed.values
        array([1150., 1550.])
    """
    for kind in ("blade", "scene"):
        if (key := f"{kind}s_file") in sections:
            allowed = f"config=, a config.yaml that names it, or {kind}s from r37.{kind}(name, file=...)"
            raise ConfigError(f"{key}: found {single_line(repr(sections[key]))}; allowed: {allowed}")
    keys = {name: plain_value(section) for name, section in sections.items()}
    if speeds is not None or speeds_rpm is not None:
        keys |= speed_keys(speeds, speeds_rpm)
    options: RunOptions = {"fidelity": fidelity, "results": results, "config": config, "cores": cores, "folder": folder}
    chosen = [] if blades is None else [chosen_blade(blade, config) for blade in several(blades, BladeChoice)]
    if scenes is None and results is not None:
        # results are a key of each scene
        scenes = scenes_named(base_of(chosen, config))
    made_on_request = [extension.name for extension in EXTENSIONS if extension.made_on_request and extension.name in sections]
    wanted = ["tables", *made_on_request] if targets is None else targets
    rubs_on = [] if scenes is None else several(scenes, SceneChoice)
    return run_of(call_of("r37.run", chosen, rubs_on, keys, options, named=True, whole=True), options, wanted)


def run_of(call: Call, options: Mapping[str, Any], targets: str | Sequence[str] = "tables") -> RunResults:
    """The `targets` of a run of the call; `options` as of RunOptions. Raises what its first failed job raises."""
    check_cores(cores := options.get("cores", 1))
    wanted = snakemake_targets(targets)
    call.tell_remarks()
    temporary = temporary_folder() if options.get("folder") is None else None
    place = Path(temporary.name) if temporary else run_folder(options["folder"])
    write_run(call, place)
    run_workflow(call.settings, place, wanted, cores)
    return RunResults(place / "results", temporary)


def named_call(
    caller: str,
    blades: Blades,
    scenes: Scenes,
    speeds: Speeds | None,
    options: Mapping[str, Any],
    keys: Mapping[str, Any] | None = None,
) -> Call:
    """The call of blades and scenes whose names stand in tables; `options` as of SweepOptions. Raises ConfigError."""
    keys = {**(keys or {}), **speed_keys(speeds, options.get("speeds_rpm"))}
    return call_of(caller, several(blades, BladeChoice), several(scenes, SceneChoice), keys, options, named=True)


_CONFIG = "config/config.yaml"

_HEADER = "# Written by a call of r37; `snakemake tables --cores 2` in this folder runs the same.\n"

_TABLES, _IMPORTED = ("profiles", "stacking_table", "designs"), ("mesh", "matrices", "sections")
"""Keys of blades.yaml with a table, which the folder gets a copy of, and with files that are too large or belong to others."""


def run_folder(folder: Path | str) -> Path:
    """The folder of a call, absolute: new, empty, or of an earlier call. Raises ConfigError for others."""
    if not isinstance(folder, str | os.PathLike):
        raise ConfigError(f"folder: found {folder!r}; allowed: a folder that is new, empty, or of an earlier call")
    path = Path(folder).absolute()
    try:
        path.mkdir(parents=True, exist_ok=True)
        config = path / _CONFIG
        if any(path.iterdir()) and not (config.is_file() and config.read_text(encoding="utf-8").startswith(_HEADER)):
            raise ConfigError(f"folder: found {folder}, which has something else in it; allowed: a new or empty folder")
        tempfile.TemporaryFile(dir=path).close()
    except OSError as error:
        refusal = f"folder: found {folder}, which cannot be written ({error.strerror})"
        raise ConfigError(f"{refusal}; allowed: one that can") from None
    return path


def write_run(call: Call, folder: Path) -> None:
    """Write all that a call asks for as the files of a study; files that have not changed stay as they are."""
    settings, root = call.settings, call.configuration.root
    documents, config = settings.documents, dict(settings.documents.config.content)
    blades = read_document(root, settings.config.blades_file)
    changes = above(call.blades)
    blades = blades.overlaid(changes) if changes else blades
    tables: dict[str, Path] = {}
    files = {
        "blades": {name: _local_entry(entry, root, tables) for name, entry in blades.content.items()},
        "scenes": {name: _run_histories(name, entry, call) for name, entry in documents.scenes.content.items()},
        "fidelity": documents.levels.content,
    }
    # first, so that a call that was killed here knows its folder again
    _write(config | {f"{kind}_file": f"config/{kind}.yaml" for kind in files}, folder / _CONFIG)
    for kind, content in files.items():
        _write(content, folder / f"config/{kind}.yaml")
    for name, source in tables.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, folder / name)
    if not (folder / "Snakefile").exists():
        add_workflow(folder)


def _local_entry(entry: Mapping[str, Any], root: Path, tables: dict[str, Path]) -> dict[str, Any]:
    """An entry of blades.yaml whose files are found from the folder of the run; `tables` gets those that are copied there."""
    changed = dict(entry)
    # hub and tip of sections may be files, those of a mesh are names of sets
    ends = [key for key in ("hub", "tip") if "sections" in entry and isinstance(entry.get(key), str)]
    ends = [key for key in ends if (root / entry[key]).is_file()]
    for key in (*_TABLES, *_IMPORTED, *ends):
        if isinstance(entry.get(key), str):
            name, source = Path(entry[key]), (root / entry[key]).absolute()
            if key not in _TABLES or not source.is_file():
                changed[key] = str(source)
            else:
                if name.is_absolute() or ".." in name.parts:
                    names = (Path(f"config/tables/{'_' * more}{source.name}") for more in count())
                    name = next(name for name in names if tables.get(str(name), source) == source)
                changed[key] = str(name)
                tables[str(name)] = source
    return changed


def _run_histories(name: str, entry: Mapping[str, Any], call: Call) -> dict[str, Any]:
    """An entry of scenes.yaml with the stress histories of those speeds alone that the call runs."""
    settings, keys = call.settings, ("stress_history_speeds_rad_s", "stress_history_speeds_rpm")
    if not any(key in entry for key in keys):
        return dict(entry)
    kept = {key: value for key, value in entry.items() if key not in keys}
    run = {speed for (_, scene), plan in settings.speed_plans.items() if scene == name for speed in plan.certain}
    return {**kept, keys[0]: [speed for speed in settings.scene_designs.entries[name].stress_history_speeds() if speed in run]}


def _write(content: Mapping[str, Any], file: Path) -> None:
    def plain(value: Any) -> Any:
        if isinstance(value, Mapping):
            return {key: plain(inner) for key, inner in value.items() if inner is not Without.KEY}
        return [plain(inner) for inner in value] if isinstance(value, list | tuple) else value

    text = _HEADER + yaml_text(plain(content))
    if not file.exists() or file.read_text(encoding="utf-8") != text:
        write_text(text, file)
