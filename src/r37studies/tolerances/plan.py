"""The plan of the tolerances: members of each blade and scene, run by one job, and what is made of them together."""

from r37core.config import Settings
from r37core.plans import paths
from r37core.plans.extension import AddedColumns, Extension, Figure
from r37core.plans.sweep_plan import Sweep

from .members import SECTION, Tolerances, members_can_be_drawn
from .ranges import MEMBERS_SHOWING

DATASET, TABLE = "<results>/tolerances.nc", "<results>/tolerances.csv"
MEMBERS = "<results>/tolerances/{blade}/{scene}/members.nc"
"""Responses and Campbell diagrams of the members of a blade and scene; the folder has the parts that they are made of."""

NAMES_THE_FIRST, RANKS = 32, 128
"""Members of which rank coefficients always found the same first number, and those that told most numbers apart."""


def targets(sweep: Sweep) -> dict[str, paths.Wildcards]:
    """The members of each blade and scene, and what is made of them."""
    pairs = sweep.settings.made(Tolerances).pairs
    return {MEMBERS: paths.run_keys(pairs), **dict.fromkeys((DATASET, TABLE), [{}] if pairs else [])}


def remarks(settings: Settings) -> list[str]:
    """How many members there are, and whether these rank the numbers."""
    tolerances, members = settings.made(Tolerances), settings.section(SECTION).members
    if not tolerances.pairs:
        return []
    lines = []
    for place, number in enumerate(tolerances.numbers):
        values = {member.values[place] for of in tolerances.all.values() for member in of.values()} - {None}
        if len(values) == 1:
            what = f"{number.key} is {values.pop():g} in all members, so it is not ranked"
            lines.append(f"tolerances.{number.section}: {what}; a wider tolerance lets it be")
    if len(tolerances.numbers) > 1 and members < RANKS:
        what = f"name the first of the numbers at best; {RANKS} tell most apart"
        if members < NAMES_THE_FIRST:
            what = f"do not rank the numbers; {NAMES_THE_FIRST} name the first, {RANKS} tell most apart"
        lines.append(f"tolerances: {members} members {what} (docs/tolerances.md#how-many-members)")
    return lines


EXTENSION = Extension(
    name="tolerances",
    section=SECTION,
    checks=(members_can_be_drawn,),
    runs=lambda settings: settings.made(Tolerances).runs,
    targets=targets,
    columns=(AddedColumns("summary", TABLE, "r37studies.tolerances.ranges.ranged_summary", MEMBERS_SHOWING),),
    offers={"members": DATASET},
    remarks=remarks,
    figures=(
        Figure(
            rule="tolerance_figure",
            name="tolerances_{blade}__{scene}",
            runs=lambda sweep: paths.run_keys(sweep.settings.made(Tolerances).pairs),
            draw="r37studies.tolerances.figures.draw_tolerances",
            files={"tolerances": DATASET, "nominal": paths.RESPONSE},
            label="tolerances",
            caption="Tolerances of blade {blade} in scene {scene}: median of all members, the band that nine tenths lie in, "
            "and the nominal run (dashed). Then the shares of the members that are dangerous (dark, with the interval of the "
            "chance), unknown (hatched) and sustained (line), and a row of the nominal run. Last, by how much each number "
            "moves three measures, with intervals: rank coefficients. Pale: may have any "
            "place in the ranking.",
        ),
    ),
    closing="r37studies.tolerances.table.closing",
)
