"""Steps of the workflow (docs/architecture.md): a sweep with the state carried on, and the join of all of them."""

import shutil
from pathlib import Path
from typing import Any

import xarray as xr

from r37core.base.dataset_file import read_dataset, write_dataset
from r37core.base.io import as_list
from r37core.base.origin import origin
from r37core.base.plain import from_plain
from r37core.base.speeds import rounded
from r37core.machine_code.kept import content_digest
from r37core.plans.paths import speed_of
from r37core.results.response import write_response
from r37core.results.table_file import write_table
from r37core.stress.statistic import Strengths

from .choice import DOWN, MOTIONS, REST, SweepChoice
from .dataset import pair_motions
from .levels import write_levels
from .sweeping import CarriedSweep
from .tables import range_table


def carry(input: Any, output: Any, params: Any) -> None:
    """Sweep through the speeds. A sweep that was interrupted goes on.

    Inputs: model, stress if needed, runs (of the pipeline, for the motion from rest). Outputs: response (nc), levels (npz).
    Params: motion, scene, choice, sweep, results, kept, yield_stress, strengths, provenance, code.
    """
    run = CarriedSweep.read(input, params, sweep=from_plain(SweepChoice, params.sweep), motion=params.motion)
    parts, speeds = Path(f"{output.levels}.parts"), run.sweep.speeds
    inputs = [input.model, *([input.stress] if run.stress else [])]
    made_of = [params.motion, params.results, params.kept, params.code, params.scene, params.choice, params.sweep]
    finished = {rounded(speed_of(file)): Path(file) for file in as_list(input.runs)}
    files = run.run(parts, [*made_of, *map(content_digest, inputs)], finished)
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
    write_levels(ascending, speeds, run.scene.casing.clearance, run.sweep.worn and run.scene.lined, output.levels)
    shutil.rmtree(parts, ignore_errors=True)


def join(input: Any, output: Any, params: Any) -> None:
    """Join all blades and scenes. Inputs: responses, levels (each motion of all pairs).

    Outputs: motions (nc), ranges (csv). Params: pairs, blades, scenes, fidelity.
    """
    parts, count = [], len(MOTIONS)
    for number, (blade, scene) in enumerate(params.pairs):
        own = slice(number * count, (number + 1) * count)
        pair = pair_motions(input.responses[own], input.levels[own])
        parts.append(pair.expand_dims({"blade": [blade], "scene": [scene]}))
    joined = xr.combine_by_coords(parts, combine_attrs="drop_conflicts")
    assert isinstance(joined, xr.Dataset)
    # NaN of those that are not swept
    motions = joined.reindex(blade=params.blades, scene=params.scenes)
    write_dataset(motions, output.motions, origin("Second motions of rubbing blades") | {"fidelity": params.fidelity})
    write_table(range_table(read_dataset(output.motions)), output.ranges, digits=6)
