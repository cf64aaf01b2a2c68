"""Steps of the workflow (docs/architecture.md): sweeps with the state carried on, dwells, their tables."""

import hashlib
import shutil
from pathlib import Path
from typing import Any

from r37core.base.dataset_file import read_dataset, write_dataset
from r37core.base.io import as_list
from r37core.base.origin import origin
from r37core.base.plain import from_plain
from r37core.contact.scene import Scene
from r37core.results.joining import Along, join_runs
from r37core.results.response import write_response
from r37core.results.table_file import write_table
from r37core.rom.contact_model import read_contact_model
from r37core.stress.operator import read_stress_operators
from r37core.time_integration.integration_choice import IntegrationChoice

from .choice import DOWN, MOTIONS, DwellChoice, SweepChoice
from .dataset import second_motions_dataset
from .examining import dwells_of
from .motion_files import SweptStates, dwell_dataset, write_states
from .sweeping import CarriedSweep
from .tables import dwell_table, range_table


def carry(input: Any, output: Any, params: Any) -> None:
    """Sweep through the speeds. Inputs: model, and stress if needed. Outputs: response (nc), states (npz).

    Params: motion, scene, choice, sweep, results, kept, yield_stress, provenance, code. One that was interrupted goes on.
    """
    run = _sweep_of(input, params, params.motion)
    made_by = [params.code, params.motion, params.scene, params.choice, params.sweep, params.results, params.kept]
    inputs = [hashlib.sha256(Path(file).read_bytes()).hexdigest() for file in (input.model, *_stress_file(input))]
    made_of = hashlib.sha256(repr([made_by, inputs]).encode()).hexdigest()[:16]
    folder = Path(f"{output.states}.parts")
    for other in folder.glob("*"):
        if other.name != made_of:
            shutil.rmtree(other, ignore_errors=True)
    files = run.run(folder / made_of)
    ascending = files[::-1] if params.motion == DOWN else files
    write_response(
        ascending,
        run.sweep.speeds,
        output.response,
        stress_history_speeds=(),
        yield_stress=params.yield_stress,
        provenance={**params.provenance, "motion": params.motion},
    )
    write_states(ascending, run.sweep.speeds, run.scene.casing.clearance, output.states)
    shutil.rmtree(folder, ignore_errors=True)


def dwell(input: Any, output: Any, params: Any) -> None:
    """Dwell where motions differ. Inputs: model, states (of all motions). Output: dwells (nc).

    Params: scene, choice, sweep, dwell, provenance.
    """
    choice = from_plain(DwellChoice, params.dwell)
    rows = dwells_of(_sweep_of(input, params), _states(input), choice)
    write_dataset(dwell_dataset(rows, choice.revolutions), output.dwells, params.provenance)


def join(input: Any, output: Any, params: Any) -> None:
    """Join the sweeps of all blades and scenes. Inputs: responses, states. Output: dataset (nc).

    Params: runs, blades, scenes, fidelity.
    """
    keys = [(run["blade"], run["scene"], run["motion"]) for run in params.runs]
    responses, states = (dict(zip(keys, as_list(files), strict=True)) for files in (input.responses, input.states))
    dataset = second_motions_dataset(responses, states, params.blades, params.scenes)
    write_dataset(dataset, output.dataset, origin("Second motions of rubbing blades") | {"fidelity": params.fidelity})


def join_parts(input: Any, output: Any, params: Any) -> None:
    """Join dwells of all blades and scenes. Inputs: parts. Output: dataset (nc). Params: pairs, along, fidelity."""
    along, title = Along(rows=params.along, dim=params.along), f"Second motions of rubbing blades: {params.along}s"
    join_runs(as_list(input.parts), params.pairs, along, output.dataset, title, params.fidelity)


def tabulate(input: Any, output: Any, params: Any) -> None:
    """List ranges of hysteresis and dwells. Inputs: dataset, dwells. Outputs: ranges, dwells (csv)."""
    verdicts = dwell_table(read_dataset(input.dwells))
    write_table(range_table(read_dataset(input.dataset), verdicts), output.ranges, digits=6)
    write_table(verdicts, output.dwells, digits=6)


def _sweep_of(input: Any, params: Any, motion: str = MOTIONS[0]) -> CarriedSweep:
    stress = _stress_file(input)
    return CarriedSweep(
        read_contact_model(input.model),
        from_plain(Scene, params.scene),
        from_plain(IntegrationChoice, params.choice),
        from_plain(SweepChoice, params.sweep),
        motion,
        getattr(params, "results", ()),
        getattr(params, "kept", {}),
        read_stress_operators(stress[0]) if stress else None,
    )


def _stress_file(input: Any) -> list[str]:
    return [input.stress] if hasattr(input, "stress") else []


def _states(input: Any) -> dict[str, SweptStates]:
    return {motion: SweptStates(file) for motion, file in zip(MOTIONS, as_list(input.states), strict=True)}
