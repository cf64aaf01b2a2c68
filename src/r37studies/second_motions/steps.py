"""Steps of the workflow (docs/architecture.md): a sweep with the state carried on, dwells, and the join of all of them."""

import shutil
from functools import partial
from pathlib import Path
from typing import Any

import xarray as xr

from r37core.base.dataset_file import read_dataset, write_dataset
from r37core.base.io import as_list
from r37core.base.origin import origin
from r37core.base.plain import from_plain
from r37core.base.speeds import exact_text, rounded
from r37core.machine_code.kept import content_digest, kept_file
from r37core.plans.paths import speed_of
from r37core.results.joining import Along, join_runs
from r37core.results.response import write_response
from r37core.results.table_file import write_table
from r37core.stress.statistic import Strengths

from .choice import DOWN, MOTIONS, REST, DwellChoice, SweepChoice
from .dataset import dwell_dataset, pair_motions
from .dwelling import dwells_at, speeds_dwelt_on
from .states import levels_of, read_states, write_states
from .sweeping import CarriedSweep
from .tables import dwell_table, range_table


def carry(input: Any, output: Any, params: Any) -> None:
    """Sweep through the speeds. A sweep that was interrupted goes on.

    Inputs: model, stress if needed, runs (of the pipeline, for the motion from rest). Outputs: response (nc), states (npz).
    Params: motion, scene, choice, sweep, results, kept, yield_stress, strengths, provenance, code.
    """
    run = _swept(input, params, motion=params.motion)
    parts, speeds = Path(f"{output.states}.parts"), run.sweep.speeds
    made_by = [params.motion, params.results, params.kept]
    finished = {rounded(speed_of(file)): Path(file) for file in as_list(input.runs)}
    files = run.run(parts, [made_by, _made_of(params, input.model, *([input.stress] if run.stress else []))], finished)
    ascending = files[::-1] if params.motion == DOWN else files
    carried = {} if params.motion == REST else {"revolutions": run.carried_choice.revolutions}
    write_response(
        ascending,
        speeds,
        output.response,
        stress_history_speeds=(),
        yield_stress=params.yield_stress,
        strengths=from_plain(Strengths, params.strengths),
        provenance={**params.provenance, "motion": params.motion, **carried},
    )
    write_states(ascending, speeds, run.scene.casing.clearance, output.states)
    shutil.rmtree(parts, ignore_errors=True)


def dwell(input: Any, output: Any, params: Any) -> None:
    """Dwell where motions differ. Inputs: model, states (of all motions). Output: dwells (nc).

    Params: scene, choice, sweep, dwell, provenance, code. Dwells that were interrupted go on from the next speed.
    """
    run, states, choice = _swept(input, params), read_states(input.states), from_plain(DwellChoice, params.dwell)
    made_of, parts = [params.dwell, _made_of(params, input.model, *input.states)], Path(f"{output.dwells}.parts")
    parts.mkdir(parents=True, exist_ok=True)

    def write(speed: float, file: Path) -> None:
        write_dataset(dwell_dataset(dwells_at(speed, run, states, choice), choice.revolutions), file, {})

    speeds = speeds_dwelt_on(levels_of(states), choice)
    files = [kept_file(f"{exact_text(speed)}.nc", made_of, partial(write, speed), parts) for speed in speeds]
    dwells = [read_dataset(file) for file in files] or [dwell_dataset([], choice.revolutions)]
    write_dataset(xr.concat(dwells, "dwell"), output.dwells, params.provenance)
    shutil.rmtree(parts, ignore_errors=True)


def join(input: Any, output: Any, params: Any) -> None:
    """Join all blades and scenes. Inputs: responses, states (each motion of all pairs), dwells.

    Outputs: motions, dwells (nc), ranges, verdicts (csv). Params: pairs, blades, scenes, fidelity.
    """
    parts, count = [], len(MOTIONS)
    for number, (blade, scene) in enumerate(params.pairs):
        own = slice(number * count, (number + 1) * count)
        pair = pair_motions(input.responses[own], read_states(input.states[own]))
        parts.append(pair.expand_dims({"blade": [blade], "scene": [scene]}))
    title, joined = "Second motions of rubbing blades", xr.combine_by_coords(parts, combine_attrs="drop_conflicts")
    assert isinstance(joined, xr.Dataset)
    # NaN of those that are not swept
    motions = joined.reindex(blade=params.blades, scene=params.scenes)
    write_dataset(motions, output.motions, origin(title) | {"fidelity": params.fidelity})
    rows = Along(rows="dwell", dim="dwell")
    join_runs(as_list(input.dwells), params.pairs, rows, output.dwells, f"{title}: dwells", params.fidelity)
    verdicts = dwell_table(read_dataset(output.dwells))
    write_table(verdicts, output.verdicts, digits=6)
    write_table(range_table(read_dataset(output.motions), verdicts), output.ranges, digits=6)


def _swept(input: Any, params: Any, **motion: str) -> CarriedSweep:
    return CarriedSweep.read(input, params, sweep=from_plain(SweepChoice, params.sweep), **motion)


def _made_of(params: Any, *inputs: str) -> list[Any]:
    """All that sweeps and dwells of a blade and scene follow from: code, parameters and the content of the inputs."""
    return [params.code, params.scene, params.choice, params.sweep, *map(content_digest, inputs)]
