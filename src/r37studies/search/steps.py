"""Steps of the workflow (docs/architecture.md): a search, round by round, and what is made of all its designs."""

import hashlib
import json
from collections.abc import Mapping
from functools import partial
from math import isfinite
from pathlib import Path
from typing import Any

from r37core.base.dataset_file import write_dataset
from r37core.base.io import JOB_NEWS
from r37core.base.origin import origin
from r37core.base.plain import to_plain
from r37core.base.units import unit_of
from r37core.results.closing import counted
from r37core.results.table_file import write_table
from r37core.sweep.forks import forked_results
from r37studies.surrogate.designs import Design, best_first, not_dominated
from r37studies.surrogate.proposal import first_designs, propose

from .dataset import search_dataset, search_table
from .designs import START, SearchChoice, choice_of
from .evaluation import Evaluation


def search(input: Any, output: Any, params: Any) -> None:
    """Search for designs, round by round. Outputs: dataset (nc), table (csv).

    Params: carried (the settings), budget (designs of each round), fidelity, cores.
    """
    settings, folder = params.carried.settings, Path(output.dataset).with_suffix("")
    choice, run_all = choice_of(settings), partial(forked_results, params.cores)
    evaluation = Evaluation(settings, folder, run_all, params.cores)
    tried: dict[str, Design] = {}
    for number, count in enumerate(params.budget):
        new = next_designs(tried, count, choice)
        JOB_NEWS.info(progress(count, tried, choice, number))
        asked = new if tried else {START: None, **new}
        for name, gave in zip(asked, evaluation.quantities(asked), strict=True):
            if name != START:
                tried[name] = choice.design(name, new[name], number, gave, tried)
            elif isinstance(gave, str):
                # what is wrong with the start is no result
                raise ValueError(gave)
            else:
                tried[START] = choice.design(START, choice.start, -1, gave, {})
    JOB_NEWS.info(progress(0, tried, choice, len(params.budget)))
    dataset = search_dataset(tried, choice)
    digest = hashlib.sha256(json.dumps(to_plain(tried)).encode()).hexdigest()[:32]
    write_dataset(dataset, output.dataset, {"fidelity": params.fidelity, "input_hash": digest} | origin("Designs of a search"))
    write_table(search_table(dataset), output.table, digits=6)


def next_designs(tried: Mapping[str, Design], count: int, choice: SearchChoice) -> dict[str, tuple[float, ...]]:
    """Values of the `count` designs that those `tried`, the start among them, ask for, by name; of the first evenly spread."""
    ranges = list(choice.entry.variables.values())
    done = len(tried.keys() - {START})
    if not tried:
        values = first_designs(ranges, count, choice.entry.seed)
    else:
        # a start at values that are not known tells nothing of those between
        known = [design for design in tried.values() if all(map(isfinite, design.values))]
        values = propose(ranges, known, count, choice.entry.seed)
    return {f"d{done + place:04d}": each for place, each in enumerate(values)}


def progress(asked: int, tried: Mapping[str, Design], choice: SearchChoice, number: int) -> str:
    """The line of round `number`, which asks for so many designs; of the end where it asks for none."""
    line = f"search: round {number}, {counted(asked, 'design')}" if asked else "search: the last round is done"
    if not tried:
        return line
    designs = [design for name, design in tried.items() if name != START]
    if len(choice.entry.objectives) > 1:
        best = f"{len(not_dominated(designs))} that none is better than in all objectives"
    else:
        ((objective, quantity),) = choice.entry.objectives.items()
        ahead = best_first(designs)[:1]
        best = "".join(f"best {each.name}, {objective} {each.objectives[0]:.4g} {unit_of(quantity.measure)}" for each in ahead)
    refused = sum(bool(design.refused) for design in designs)
    cannot = f", {refused} of them cannot be built" if refused else ""
    return f"{line}; {len(designs)} tried{cannot}: {best or 'none can be built and keeps all constraints'}"
