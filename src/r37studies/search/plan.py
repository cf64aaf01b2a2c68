"""The plan of a search: what its job computes with, and what is made of all its designs."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from r37core.base.plain import to_plain
from r37core.config import Settings, operating_range, plain
from r37core.config.settings import most_runs
from r37core.plans import paths
from r37core.plans.extension import Extension, Figure
from r37core.plans.extent import Pair, Runs
from r37core.plans.sweep_plan import Sweep
from r37core.sweep.driver import one_by_one
from r37studies.carried import Carried

from .checks import search_can_be_run
from .designs import FOLDER, START, choice_of, designs_of, is_asked
from .section import SECTION

DATASET, TABLE = "<results>/search.nc", "<results>/search.csv"


@dataclass(frozen=True)
class Search:
    """Plan of the search of these `settings`; methods with `wildcards` as of Sweep."""

    settings: Settings

    def carried(self, wildcards: Any) -> Carried:
        """The settings, of which designs are made."""
        return Carried(self.settings)

    def made_of(self, wildcards: Any) -> list[Any]:
        """All that a search follows from, as plain values.

        Runs of other designs follow from the same as the start's.
        """
        settings, designs = self.settings, designs_of(self.settings)
        # which imports what makes structures, and only a search needs here
        from .evaluation import Evaluation

        start = Evaluation(settings, Path(), one_by_one, 1).runs(START, None)
        entries = [plain(designs.start), *(plain(settings.scene_designs.entries[scene]) for scene in designs.scenes)]
        choice = choice_of(settings)
        return to_plain([start.made_of, plain(choice.entry), choice.start, operating_range(settings), entries])

    def budget(self, wildcards: Any) -> list[int]:
        """Number of designs of each round."""
        entry = designs_of(self.settings).entry
        more = range(entry.first, entry.designs, entry.batch)
        return [entry.first, *(min(entry.batch, entry.designs - done) for done in more)]


def _once(sweep: Sweep) -> paths.Wildcards:
    return [{}] if is_asked(sweep.settings) else []


def targets(sweep: Sweep) -> dict[str, paths.Wildcards]:
    """The dataset and the table."""
    return dict.fromkeys((DATASET, TABLE), _once(sweep))


def simulations(settings: Settings) -> dict[Pair, Runs]:
    """Simulations of the designs and the start, by blade and scene."""
    if not is_asked(settings):
        return {}
    designs = designs_of(settings)
    entry = designs.entry
    runs = 1 + entry.designs
    pairs = [(entry.blade, scene) for scene in designs.scenes]
    return {
        pair: Runs(
            runs * most_runs(settings, *pair), runs * len(settings.speed_plans[pair].certain), models=entry.designs / len(pairs)
        )
        for pair in pairs
    }


EXTENSION = Extension(
    name=FOLDER,
    section=SECTION,
    checks=(search_can_be_run,),
    runs=simulations,
    targets=targets,
    figures=(
        Figure(
            rule="search_designs_figure",
            name="search_designs",
            runs=_once,
            draw="r37studies.search.figures.draw_designs",
            files={"search": DATASET},
            label="designs",
            caption="Designs of the search; small is good. First the best value of each objective so far among designs that "
            "keep all constraints, over the number of designs. Dashed: the start; dotted: the end of the first, quasi-random "
            "designs. Then the objectives against each other. Designs that break a constraint are pale. Of those in orange no "
            "other that keeps the constraints is better in all objectives. Bars: standard deviation by chance.",
            category="Search",
        ),
    ),
    closing="r37studies.search.dataset.closing",
)
