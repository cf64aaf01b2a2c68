"""Steps of the workflow (docs/architecture.md): what the members of a sample give together."""

import math
from typing import Any

from r37core.base.dataset_file import attributes_of, joined_hash, read_dataset, write_dataset
from r37core.base.io import as_list
from r37core.base.origin import origin
from r37core.base.plain import from_plain
from r37core.results.interactions import InteractionChoice, find_interactions
from r37core.results.regions import read_judged
from r37core.results.table_file import write_table

from .dataset import MemberRun, tolerances_dataset
from .table import range_table, ranges


def join(input: Any, output: Any, params: Any) -> None:
    """Join the members' responses. Inputs: responses. Params: members, numbers, values, fidelity. Output: dataset (nc)."""
    files = as_list(input.responses)
    runs = (
        MemberRun(**member, values=tuple(math.nan if value is None else value for value in values), file=file)
        for member, values, file in zip(params.members, params.values, files, strict=True)
    )
    made = {"fidelity": params.fidelity, "input_hash": joined_hash(attributes_of(files))} | origin("Members under tolerances")
    write_dataset(tolerances_dataset(runs, params.numbers), output.dataset, made)


def table(input: Any, output: Any, params: Any) -> None:
    """List interactions with their ranges. Params: members, choice. Output: table (csv).

    Inputs: responses and campbells of the members, nominal and nominal_campbells of the nominal runs.
    """
    choice = from_plain(InteractionChoice, params.choice)

    def read(responses: Any, campbells: Any) -> Any:
        for file, campbell in zip(as_list(responses), as_list(campbells), strict=True):
            response = read_judged(file)
            yield find_interactions(response, read_dataset(campbell), choice), response["speed"].values[[0, -1]]

    members: dict[tuple[str, str], dict[str, Any]] = {}
    speeds: dict[tuple[str, str], tuple[float, float]] = {}
    for member, (interactions, ends) in zip(params.members, read(input.responses, input.campbells), strict=True):
        pair = member["blade"], member["scene"]
        members.setdefault(pair, {})[member["member"]] = interactions
        speeds[pair] = tuple(ends)
    nominal = read(input.nominal, input.nominal_campbells)
    rows = [
        (*pair, row)
        for pair, (interactions, _) in zip(members, nominal, strict=True)
        for row in ranges(interactions, members[pair], choice, speeds[pair])
    ]
    write_table(range_table(rows), output.table)
