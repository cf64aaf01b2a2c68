"""The one door to runs of the workflow: any blades, scenes, speeds and sections of the configuration."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from r37core.base.io import temporary_folder
from r37core.config import ConfigError
from r37core.config.messages import single_line
from r37core.config.named_files import located_in_configuration
from r37core.product.extensions import EXTENSIONS

from .arguments import Speeds, plain_value, speed_keys
from .call_settings import call_of, several
from .choices import BladeChoice, SceneChoice
from .jobs import check_cores
from .run_folder import run_folder, write_run
from .run_results import RunResults
from .stages import stages
from .workflow_process import run_workflow, snakemake_targets


@stages()
def run(
    blades: BladeChoice | str | Sequence[BladeChoice | str] | None = None,
    scenes: SceneChoice | str | Sequence[SceneChoice | str] | None = None,
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

    Blades compared: `r37.run(["Ref", "CS100"], "abradable", speeds).ranking`. Further sections and keys do more:

        r37.run("Ref", "abradable", speeds, tolerances={"of_scenes": {"friction.coefficient": {"uniform_percent": 5}}})
        r37.run("Ref", "abradable", speeds, search={"blade": "Ref", "variables": {...}, "objectives": {...}}).best_values()
        r37.run(r37.blade("S100", name="Sweep", vary={"sweep_percent": [50, 100]}), "abradable", speeds).tables["designs"]
        wheel = r37.scene("abradable", name="wheel", rotor={"blades": 36}, results=["stress"])
        r37.run("Ref", wheel, speeds).rotor("Ref", "wheel")
        r37.run("Ref", "abradable", run_ups={"up": {...}}, targets="results/run_ups.nc")["run_ups"]
        points = {"blade": "Ref", "scene": "abradable", "file": table, "quantity": "displacement_tangential"}
        r37.run("Ref", "abradable", measured=[points], targets="measured_table").tables["measured"]

    Args:
        blades, scenes: Names, or the results of `r37.blade` and `r37.scene`; changed ones and families need a `name`. By
            default those of the configuration.
        speeds: As of `r37.sweep`. By default those of the configuration.
        speeds_rpm: The same in revolutions per minute, in place of `speeds`.
        fidelity: An accuracy level in place of the configuration's.
        results: Results to compute, in place of the scenes' lists: `["stress", "wear"]`.
        config: A config.yaml in place of the shipped one. All of it counts that no other argument replaces.
        cores: Number of jobs that run at once. The numbers do not depend on it.
        folder: Folder of the run's files: new, empty, or of an earlier call, which continues. `snakemake` in that folder runs
            the same. By default the files are temporary: they are deleted with the returned object.
        targets: Rules or files, as Snakemake takes them: `"all_blades"` draws all figures, `["tables", "exports"]` writes
            more. By default the tables, and what `sections` ask for that is made on request alone: exports, tradeoff,
            stability, estimate.
        **sections: Sections of config.yaml by name, in the units of their keys, also those of extensions. A DataFrame may
            stand for a table's file.

    Returns:
        As of `r37.open_results`.

    Raises:
        ConfigError: For bad input.
        ValueError: For an impossible shape, mesh, model or time step.
        BucklingError: For a blade that its load buckles.

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
    chosen = several(blades, BladeChoice), several(scenes, SceneChoice)
    call = call_of("r37.run", *chosen, keys, config=config, fidelity=fidelity, results=results, whole=True)
    check_cores(cores)
    made_on_request = [extension.name for extension in EXTENSIONS if extension.made_on_request and extension.name in sections]
    wanted = snakemake_targets(["tables", *made_on_request] if targets is None else targets)
    call.tell_remarks()
    temporary = temporary_folder() if folder is None else None
    place = run_folder(folder) if temporary is None else Path(temporary.name)
    write_run(call, place)
    try:
        run_workflow(call.settings, place, wanted, cores)
    except KeyboardInterrupt as interruption:
        if temporary is None:
            interruption.add_note(f"stopped; the same call goes on with what is in {place}")
        raise
    return RunResults(place / "results", temporary)
