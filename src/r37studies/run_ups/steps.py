"""Steps of the workflow (docs/architecture.md): run-ups, their dataset, their tables."""

from typing import Any

from r37core.base.dataset_file import read_dataset
from r37core.base.io import as_list
from r37core.base.plain import from_plain
from r37core.results.table_file import write_table
from r37core.stress.operator import judged_operator
from r37core.stress.statistic import Strengths
from r37core.time_integration.speed_file import write_speed
from r37studies.blade_runs import BladeRuns
from r37studies.run_up_integration import RunUpIntegration
from r37studies.run_up_revolutions import record_run_up

from .choice import RunUpChoice
from .dataset import VARIABLES, write_run_ups
from .tables import rate_table, run_up_table


def record(input: Any, output: Any, params: Any) -> None:
    """Do one run-up. Inputs: model, and stress and campbell if needed. Output: run_up (npz).

    Params: scene, choice, run_up, name, results, highest_order, yield_stress, strengths, provenance.
    """
    blade = BladeRuns.read(input, params)
    campbell = read_dataset(input.campbell) if hasattr(input, "campbell") else None
    run_up = from_plain(RunUpChoice, params.run_up).blade_run_up(blade.choice.samples_per_revolution, campbell, params.name)
    result = record_run_up(
        RunUpIntegration(blade.model, blade.scene, blade.choice, run_up),
        blade.results,
        highest_order=params.highest_order,
        stress=judged_operator(blade.stress) if blade.stress else None,
        yield_stress=params.yield_stress,
        strengths=from_plain(Strengths, params.strengths),
    )
    write_speed(result, output.run_up, params.provenance, VARIABLES)


def join(input: Any, output: Any, params: Any) -> None:
    """Join run-ups. Inputs: run_ups, of each blade and scene. Params: runs, fidelity. Output: dataset (nc)."""
    files = dict(zip(map(tuple, params.runs), as_list(input.run_ups), strict=True))
    write_run_ups(files, output.dataset, {"fidelity": params.fidelity})


def tables(input: Any, output: Any, params: Any) -> None:
    """List run-ups and the rates they need. Input: dataset. Outputs: runs, rates (csv)."""
    runs = run_up_table(read_dataset(input.dataset))
    for table, file in ((runs, output.runs), (rate_table(runs), output.rates)):
        write_table(table, file, digits=9)
