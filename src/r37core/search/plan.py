"""The plan of a search: what its job computes with, and what is made of all its designs."""

from dataclasses import dataclass
from typing import Any

from r37core.base.plain import to_plain
from r37core.blade.profile_tables import stacking_table_rows
from r37core.config import Settings, plain
from r37core.config.settings import most_runs
from r37core.plans import paths
from r37core.plans.extension import Extension, Figure
from r37core.plans.sweep_plan import Sweep

from .checks import search_can_be_run
from .designs import FOLDER, SearchDesigns, choice_of, designs_of, is_asked
from .evaluation import Carried, start_runs
from .section import SECTION

DATASET, TABLE = "<results>/search.nc", "<results>/search.csv"
BEST = "<results>/search/best"
"""Folder of the best designs' entries, of blades with STEP files and of scenes."""


@dataclass(frozen=True)
class Search:
    """Plan of the search of these `settings`; methods with `wildcards` as of Sweep."""

    settings: Settings

    @property
    def designs(self) -> SearchDesigns:
        """Designs of the search."""
        return designs_of(self.settings)

    def carried(self, wildcards: Any) -> Carried:
        """The settings, of which designs are made."""
        return Carried(self.settings)

    def start(self, wildcards: Any) -> dict[str, Any]:
        """All that the start's runs follow from, as plain values: those of other designs follow from the same."""
        return to_plain(start_runs(self.settings))

    def choice(self, wildcards: Any) -> dict[str, Any]:
        """Variables, objectives and constraints, as plain values."""
        return to_plain(choice_of(self.settings))

    def tolerances(self, wildcards: Any) -> dict[str, Any] | None:
        """Tolerances about each design, as plain values."""
        tolerances = self.designs.entry.tolerances
        return None if tolerances is None else plain(tolerances)

    def budget(self, wildcards: Any) -> list[int]:
        """Number of designs of each round."""
        entry = self.designs.entry
        more = range(entry.first, entry.designs, entry.batch)
        return [entry.first, *(min(entry.batch, entry.designs - done) for done in more)]

    def threads(self, wildcards: Any) -> int:
        """Number of designs of the largest round."""
        return max(self.budget(wildcards))

    def entries(self, wildcards: Any) -> dict[str, Any]:
        """Entries of blades.yaml that the designs start at, as plain values: bases first, the start with its table last.

        None where no variable is of the blade.
        """
        if not self.designs.blade_varies:
            return {}
        entries, chain = self.settings.designs.entries, [self.designs.entry.blade]
        while (base := getattr(entries[chain[0]], "base", None)) is not None:
            chain.insert(0, base)
        plain = {name: entries[name].model_dump(exclude_none=True, exclude_unset=True) for name in chain}
        if (table := plain[chain[-1]].pop("stacking_table", None)) is not None:
            plain[chain[-1]]["sweep_lean"] = stacking_table_rows(self.settings.root / table, chain[-1])
        return plain

    def scene_entries(self, wildcards: Any) -> dict[str, Any]:
        """Entries of scenes.yaml that the designs start at, as plain values; none where no variable is of scenes."""
        if not any(self.varied_in_scenes(wildcards).values()):
            return {}
        entries = self.settings.scene_designs.entries
        return {scene: entries[scene].model_dump(exclude_none=True, exclude_unset=True) for scene in self.designs.scenes}

    def varied_in_scenes(self, wildcards: Any) -> dict[str, list[str]]:
        """Scene -> variables that are of numbers which it has."""
        designs = self.designs
        return {
            scene: [number.name for number in designs.numbers if scene in designs.values_in_scenes(number)]
            for scene in designs.scenes
        }


def _once(sweep: Sweep) -> paths.Wildcards:
    return [{}] if is_asked(sweep.settings) else []


def targets(sweep: Sweep) -> dict[str, paths.Wildcards]:
    """The dataset, the table and the best designs."""
    return dict.fromkeys((DATASET, TABLE, BEST), _once(sweep))


def remarks(settings: Settings) -> list[str]:
    """How many simulations a search asks for."""
    if not is_asked(settings):
        return []
    designs = designs_of(settings)
    entry = designs.entry
    members = 1 + (entry.tolerances.members if entry.tolerances else 0)
    runs = members * sum(most_runs(settings, entry.blade, scene) for scene in designs.scenes)
    words = f"{entry.designs} designs of '{entry.blade}' in rounds of {entry.batch}"
    return [f"search: {words}, at most {runs} simulations of each, beside those of the sweep (docs/better_blade.md)"]


EXTENSION = Extension(
    name=FOLDER,
    section=SECTION,
    checks=(search_can_be_run,),
    targets=targets,
    remarks=remarks,
    figures=(
        Figure(
            rule="search_designs_figure",
            name="search_designs",
            runs=_once,
            draw="search.figures.draw_designs",
            files={"search": DATASET},
            label="designs",
            caption="Designs of the search; small is good. Left: the best value of each objective so far among designs that "
            "keep all constraints, over the number of designs. Dashed: the start; dotted: the end of the first, quasi-random "
            "designs. Right: the objectives against each other, or a single one over the rounds. Designs that break a "
            "constraint are pale. Of those in orange no other that keeps the constraints is better in all objectives. Bars: "
            "standard deviation by chance.",
            category="Search",
        ),
        Figure(
            rule="search_slices_figure",
            name="search_slices",
            runs=_once,
            draw="search.figures.draw_slices",
            files={"search": DATASET},
            label="slices",
            caption="Each objective along each variable. The line is the mean of the surrogate, the band two standard "
            "deviations; the other variables are those of the best design. Points are the designs, which differ in the other "
            "variables, too. Above: share of the surrogate's variance in which the variable has a part. Beside: Q2, the share "
            "of the designs' variance that the surrogate predicts at designs left out.",
            category="Search",
        ),
    ),
    closing="search.dataset.closing",
)
