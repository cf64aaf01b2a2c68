"""Rounds of a search: which designs a round asks for, and what those before it gave."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from math import isfinite

from r37core.base.plain import to_plain
from r37core.results.closing import counted

from .problem import QUASI_RANDOM, START, Design, SearchChoice, Value, best_first, not_dominated
from .proposal import first_designs, propose


@dataclass(frozen=True)
class SearchRound:
    """One round: values of the `new` designs, none in the last, and all `tried` before; `start`: quantities of the start."""

    new: Mapping[str, tuple[float, ...]]
    tried: Mapping[str, Design] = field(default_factory=dict)
    start: Mapping[str, Value] = field(default_factory=dict)

    @property
    def digest(self) -> str:
        """Short hash of all designs and what they gave."""
        return hashlib.sha256(json.dumps(to_plain(self)).encode()).hexdigest()[:32]


def first_round(count: int, choice: SearchChoice) -> SearchRound:
    """The first `count` designs, evenly over the bounds."""
    return SearchRound(_named(first_designs(choice.variables, count, choice.seed), 0))


def tried_after(
    before: SearchRound, number: int, refused: Mapping[str, str], gave: Mapping[str, Mapping[str, Value]]
) -> dict[str, Design]:
    """All designs tried before round `number`: those `before` it were `refused`, each with a reason, or `gave` quantities."""
    new = {name: Design(values, number - 1, refused.get(name), gave.get(name, {})) for name, values in before.new.items()}
    return {**before.tried, **new}


def round_after(tried: Mapping[str, Design], start: Mapping[str, Value], count: int, choice: SearchChoice) -> SearchRound:
    """The round of `count` designs that what was `tried`, and the start's quantities, ask for."""
    if not count:
        return SearchRound({}, tried, start)
    if choice.method == QUASI_RANDOM:
        new = first_designs(choice.variables, len(tried) + count, choice.seed)[len(tried) :]
    else:
        known = {START: choice.start_design(start), **tried}
        evaluated = [design.evaluated(name, choice, start) for name, design in known.items()]
        # a start at values that are not known tells nothing of those between
        evaluated = [each for each in evaluated if all(map(isfinite, each.values))]
        new = propose(choice.variables, evaluated, count, choice.seed)
    return SearchRound(_named(new, len(tried)), tried, start)


def _named(values: list[tuple[float, ...]], before: int) -> dict[str, tuple[float, ...]]:
    return {f"d{before + place:04d}": each for place, each in enumerate(values)}


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
