"""What a search says while it runs: how far it is, and what is the best so far."""

from __future__ import annotations

from r37core.results.closing import counted

from .choice import SearchChoice
from .pareto import best_first, not_dominated
from .rounds import SearchRound


def progress(asked: SearchRound, choice: SearchChoice, number: int) -> str:
    """The line of round `number`."""
    line = f"search: round {number}, {counted(len(asked.new), 'design')}" if asked.new else "search: the last round is done"
    return f"{line}; {_so_far(asked, choice)}" if asked.tried else line


def _so_far(asked: SearchRound, choice: SearchChoice) -> str:
    evaluated = [design.evaluated(name, choice, asked.start) for name, design in asked.tried.items()]
    if len(choice.objectives) > 1:
        best = f"{len(not_dominated(evaluated))} that none is better than in all objectives"
    else:
        ((objective, quantity),) = choice.objectives.items()
        ahead = best_first(evaluated)[:1]
        best = "".join(f"best {each.name}, {objective} {each.objectives[0]:.4g} {quantity.unit}" for each in ahead)
    refused = sum(design.refused is not None for design in asked.tried.values())
    cannot = f", {refused} of them cannot be built" if refused else ""
    return f"{len(evaluated)} tried{cannot}: {best or 'none can be built and keeps all constraints'}"
