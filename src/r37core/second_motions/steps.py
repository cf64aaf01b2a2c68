"""Steps of the workflow (docs/architecture.md): a sweep with the state carried on, dwells, and the join of all of them."""

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
from r37core.rom.contact_model import ContactModel, read_contact_model
from r37core.stress.operator import read_stress_operators
from r37core.time_integration.integration_choice import IntegrationChoice

from .choice import DOWN, MOTIONS, DwellChoice, SweepChoice
from .dataset import dwell_dataset, joined_motions, pair_motions
from .dwelling import dwells_of
from .states import read_states, write_states
from .sweeping import CarriedSweep
from .tables import dwell_table, range_table


def carry(input: Any, output: Any, params: Any) -> None:
    """Sweep through the speeds. Inputs: model, and stress if needed. Outputs: response (nc), states (npz).

    Params: motion, scene, choice, sweep, results, kept, yield_stress, provenance, code. A sweep that was interrupted goes on.
    """
    stress = read_stress_operators(input.stress) if hasattr(input, "stress") else None
    run = CarriedSweep(*_swept(input, params), params.motion, params.results, params.kept, stress)
    parts = Path(f"{output.states}.parts")
    files, speeds = run.run(_folder_of_same(parts, input, params)), run.sweep.speeds
    ascending = files[::-1] if params.motion == DOWN else files
    write_response(
        ascending,
        speeds,
        output.response,
        stress_history_speeds=(),
        yield_stress=params.yield_stress,
        provenance={**params.provenance, "motion": params.motion},
    )
    write_states(ascending, speeds, run.scene.casing.clearance, output.states)
    shutil.rmtree(parts, ignore_errors=True)


def dwell(input: Any, output: Any, params: Any) -> None:
    """Dwell where motions differ. Inputs: model, states (of all motions). Output: dwells (nc).

    Params: scene, choice, sweep, dwell, provenance.
    """
    choice = from_plain(DwellChoice, params.dwell)
    rows = dwells_of(CarriedSweep(*_swept(input, params)), read_states(input.states), choice)
    write_dataset(dwell_dataset(rows, choice.revolutions), output.dwells, params.provenance)


def join(input: Any, output: Any, params: Any) -> None:
    """Join all blades and scenes. Inputs: responses, states (each motion of all pairs), dwells.

    Outputs: motions, dwells (nc), ranges, verdicts (csv). Params: pairs, blades, scenes, fidelity.
    """
    parts, count = {}, len(MOTIONS)
    for number, pair in enumerate(params.pairs):
        own = slice(number * count, (number + 1) * count)
        parts[tuple(pair)] = pair_motions(input.responses[own], read_states(input.states[own]))
    title = "Second motions of rubbing blades"
    motions = joined_motions(parts, params.blades, params.scenes)
    write_dataset(motions, output.motions, origin(title) | {"fidelity": params.fidelity})
    rows = Along(rows="dwell", dim="dwell")
    join_runs(as_list(input.dwells), params.pairs, rows, output.dwells, f"{title}: dwells", params.fidelity)
    verdicts = dwell_table(read_dataset(output.dwells))
    write_table(verdicts, output.verdicts, digits=6)
    write_table(range_table(read_dataset(output.motions), verdicts), output.ranges, digits=6)


def _swept(input: Any, params: Any) -> tuple[ContactModel, Scene, IntegrationChoice, SweepChoice]:
    scene, choice = from_plain(Scene, params.scene), from_plain(IntegrationChoice, params.choice)
    return read_contact_model(input.model), scene, choice, from_plain(SweepChoice, params.sweep)


def _folder_of_same(parts: Path, input: Any, params: Any) -> Path:
    """Folder for the speeds of a sweep in `parts`, which has those of one that was interrupted.

    Those of other code, inputs or parameters are removed.
    """
    made_by = [params.code, params.motion, params.scene, params.choice, params.sweep, params.results, params.kept]
    files = [getattr(input, name) for name in ("model", "stress") if hasattr(input, name)]
    inputs = [hashlib.sha256(Path(file).read_bytes()).hexdigest() for file in files]
    made_of = hashlib.sha256(repr([made_by, inputs]).encode()).hexdigest()[:16]
    for other in parts.glob("*"):
        if other.name != made_of:
            shutil.rmtree(other, ignore_errors=True)
    return parts / made_of
