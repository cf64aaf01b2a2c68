"""The one door to runs of the workflow: any blades, scenes, speeds and sections of the configuration."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from r37core.base.io import temporary_folder
from r37core.config import ConfigError
from r37core.config.messages import single_line
from r37core.config.named_files import located_in_configuration
from r37core.product.extensions import EXTENSIONS

from .arguments import Speeds, plain_value, speed_keys
from .call_settings import Call, OneOptions, base_of, call_of, chosen_blade, several
from .choices import BladeChoice, SceneChoice, scenes_named
from .jobs import check_cores
from .run_folder import run_folder, write_run
from .run_results import RunResults
from .stages import checked_call
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
    keys = located_in_configuration(plain_value(sections), Path.cwd() / "call", None)
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
    try:
        run_workflow(call.settings, place, wanted, cores)
    except KeyboardInterrupt as interruption:
        if temporary is None:
            interruption.add_note(f"stopped; the same call goes on with what is in {place}")
        raise
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
