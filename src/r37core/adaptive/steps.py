"""Steps of the workflow (docs/architecture.md): which speeds are run next."""

from typing import Any

from r37core.base.dataset_file import read_dataset
from r37core.base.io import as_list
from r37core.base.plain import from_plain
from r37core.base.speeds import SpeedPlan

from .criterion import RefinementChoice
from .rounds import first_round, measure_members, read_round, round_after, write_round


def refine(input: Any, output: Any, params: Any) -> None:
    """Ask for the next speeds. Inputs: campbell first, then before and speeds. Output: round.

    Params: plan, choice, yield_stress.
    """
    plan, choice = from_plain(SpeedPlan, params.plan), from_plain(RefinementChoice, params.choice)
    if hasattr(input, "campbell"):
        new_round = first_round(plan, read_dataset(input.campbell), choice)
    else:
        before = read_round(input.before)
        measured = measure_members([params.yield_stress], before.new, as_list(input.speeds))
        new_round = round_after(before, measured, plan, choice)
    write_round(new_round, output.round)
