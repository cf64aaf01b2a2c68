"""List interactions with their ranges. Inputs: responses and campbells of members and nominal runs. Output: tolerances.csv."""

from job import run

from r37core.dataset_file import read_dataset
from r37core.io import as_list
from r37core.plain import from_plain
from r37core.results.interactions import InteractionChoice, find_interactions
from r37core.results.table_file import write_table
from r37core.tolerances.table import range_table, ranges


def main(snakemake):
    given, params = snakemake.input, snakemake.params
    choice = from_plain(InteractionChoice, params.choice)

    def found(responses, campbells):
        for one, campbell in zip(as_list(responses), as_list(campbells), strict=True):
            response = read_dataset(one)
            yield find_interactions(response, read_dataset(campbell), choice), response["speed"].values[[0, -1]]

    members, speeds = {}, {}
    for one, (interactions, ends) in zip(params.members, found(given.responses, given.campbells), strict=True):
        pair = one["blade"], one["scene"]
        members.setdefault(pair, {})[one["member"]] = interactions
        speeds[pair] = tuple(ends)
    nominal = found(given.nominal, given.nominal_campbells)
    rows = [
        (*pair, row)
        for pair, (one, _) in zip(members, nominal, strict=True)
        for row in ranges(one, members[pair], choice, speeds[pair])
    ]
    write_table(range_table(rows), snakemake.output[0])


run(snakemake, main)
