"""Rounds of a search: which designs a round asks for, and the line that tells of it."""

from collections.abc import Mapping
from math import isfinite

from r37core.results.closing import counted

from .problem import QUASI_RANDOM, START, Design, SearchChoice, best_first, not_dominated
from .proposal import first_designs, propose


def next_designs(tried: Mapping[str, Design], count: int, choice: SearchChoice) -> dict[str, tuple[float, ...]]:
    """Values of the `count` designs that those `tried`, the start among them, ask for, by name; of the first evenly spread."""
    done = len([name for name in tried if name != START])
    if not tried or choice.method == QUASI_RANDOM:
        values = first_designs(choice.variables, done + count, choice.seed)[done:]
    else:
        # a start at values that are not known tells nothing of those between
        known = [design for design in tried.values() if all(map(isfinite, design.values))]
        values = propose(choice.variables, known, count, choice.seed)
    return {f"d{done + place:04d}": each for place, each in enumerate(values)}


def progress(asked: int, tried: Mapping[str, Design], choice: SearchChoice, number: int) -> str:
    """The line of round `number`, which asks for so many designs; of the end where it asks for none."""
    line = f"search: round {number}, {counted(asked, 'design')}" if asked else "search: the last round is done"
    return f"{line}; {_so_far(tried, choice)}" if tried else line


def _so_far(tried: Mapping[str, Design], choice: SearchChoice) -> str:
    designs = [design for name, design in tried.items() if name != START]
    if len(choice.objectives) > 1:
        best = f"{len(not_dominated(designs))} that none is better than in all objectives"
    else:
        ((objective, quantity),) = choice.objectives.items()
        ahead = best_first(designs)[:1]
        best = "".join(f"best {each.name}, {objective} {each.objectives[0]:.4g} {quantity.unit}" for each in ahead)
    refused = sum(bool(design.refused) for design in designs)
    cannot = f", {refused} of them cannot be built" if refused else ""
    return f"{len(designs)} tried{cannot}: {best or 'none can be built and keeps all constraints'}"
