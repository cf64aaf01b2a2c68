"""The plan of a search: rounds of designs, what each design is judged by, and what is made of all of them."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from itertools import count
from pathlib import Path
from typing import Any

from r37core.base.io import read_json
from r37core.base.plain import to_plain
from r37core.blade.profile_tables import stacking_table_rows
from r37core.config import ConfigError, Settings
from r37core.config.changed_numbers import ImpossibleValueError
from r37core.config.speed_choice import most_runs
from r37core.plans import paths
from r37core.plans.extension import Extension, Figure, Panel
from r37core.plans.samples import NOMINAL, Pair, Sample, path_part
from r37core.plans.sweep_plan import Sweep

from .checks import search_can_be_run
from .designs import FOLDER, SearchDesigns, choice_of, designs_of, is_asked, member_part
from .problem import START
from .rounds import SearchRound, read_round
from .section import SECTION

ROUND = "<results>/search/round_{round}.json"
BUILT = "<results>/search/built_{round}.json"
SHAPE = "<results>/search/{design}/shape.json"
MEASURES = "<results>/search/{design}/measures.json"
DATASET, TABLE = "<results>/search.nc", "<results>/search.csv"
BEST = "<results>/search/best"
"""Folder of the best designs' entries, of blades with STEP files and of scenes."""

DESIGN_NAME = rf"{START}|d\d{{4}}"


@dataclass(frozen=True)
class Search:
    """Plan of a `sweep`'s search, `wildcards` as of Sweep.

    `round_file`, `built_file`: path of a round, of its shapes; Snakemake's own exception for one that is still to be made.
    """

    sweep: Sweep
    round_file: Callable[[int], str]
    built_file: Callable[[int], str]

    @property
    def designs(self) -> SearchDesigns:
        """Designs of the search."""
        return designs_of(self.sweep.settings)

    def choice(self, wildcards: Any) -> dict[str, Any]:
        """Variables, objectives and constraints, as plain values."""
        return to_plain(choice_of(self.sweep.settings))

    def number_of_designs(self, wildcards: Any) -> int:
        """Designs of a round."""
        entry, number = self.designs.entry, int(wildcards.round)
        if number == 0:
            return entry.first
        return max(0, min(entry.batch, entry.designs - entry.first - (number - 1) * entry.batch))

    def budget(self, wildcards: Any) -> list[int]:
        """All that says how many designs each round has."""
        entry = self.designs.entry
        return [entry.designs, entry.first, entry.batch]

    def _built(self, number: int) -> list[str]:
        """Designs of a round that could be built."""
        refused = read_json(self.built_file(number))
        return [name for name in round_of(self.round_file(number)).new if name not in refused]

    def round_inputs(self, wildcards: Any) -> dict[str, Any]:
        """Input files of a round: the round before it, and the results of its designs."""
        number = int(wildcards.round)
        if number == 0:
            return {}
        return {
            "before": self.round_file(number - 1),
            "built": self.built_file(number - 1),
            "start": paths.fill(MEASURES, design=START),
            "measures": [paths.fill(MEASURES, design=name) for name in self._built(number - 1)],
        }

    def shapes(self, wildcards: Any) -> list[str]:
        """Files that say whether each design of a round can be built."""
        return [paths.fill(SHAPE, design=name) for name in round_of(self.round_file(int(wildcards.round))).new]

    def shape(self, wildcards: Any) -> dict[str, Any]:
        """Definition of a design's shape, none where it is the start's, and why there is none; as plain values."""
        try:
            samples = self._samples(wildcards.design)
        except (ConfigError, ImpossibleValueError) as error:
            return {"definition": None, "refused": str(error)}
        if not self.designs.blade_varies:
            return {"definition": None, "refused": None}
        (blade, *_) = (member.blade for sample in samples.values() for member in sample.members.values())
        return {"definition": to_plain(blade.definition), "refused": None}

    def measured(self, wildcards: Any) -> dict[str, Any]:
        """Files of the structure and the runs of a design, or of the start."""
        own, blade = member_part(wildcards.design), self.designs.entry.blade
        model, tip_line = self.designs.model_part(wildcards.design), self.sweep.settings.structure.boundary.tip_line
        of = {"member": model, "blade": blade, "tip_line": tip_line}
        return {
            "geometry": paths.fill(paths.GEOMETRY, **of),
            "campbell": paths.fill(paths.CAMPBELL, **of),
            "contact": paths.fill(paths.CONTACT_MODEL, **of),
            "stress": paths.fill(paths.STRESS_OPERATOR, **of),
            "responses": [
                paths.fill(paths.RESPONSE, member=own + path_part("", member), blade=blade, scene=scene)
                for (_, scene), sample in self._samples(wildcards.design).items()
                for member in sample.members
            ],
        }

    def responses_of_scenes(self, wildcards: Any) -> dict[str, int]:
        """How many of the responses are of each scene, the nominal one first."""
        return {scene: len(sample.members) for (_, scene), sample in self._samples(wildcards.design).items()}

    def _samples(self, design: str) -> Mapping[Pair, Sample]:
        return self.sweep.samples.beside[f"{FOLDER}/{design}"]

    def density(self, wildcards: Any) -> float:
        """Density of a design (kg/m3)."""
        material = next(iter(self._samples(wildcards.design).values())).members[NOMINAL].blade.material
        assert material is not None
        return material.density

    @property
    def rounds(self) -> range:
        """Numbers of all rounds that have designs."""
        entry = self.designs.entry
        return range(1 + -(-(entry.designs - entry.first) // entry.batch))

    def last_round(self, wildcards: Any) -> str:
        """The round that asks for no more: known before, for what waits for a checkpoint forgets why it has to run."""
        return paths.fill(ROUND, round=len(self.rounds))

    def shapes_of_all(self, wildcards: Any) -> list[str]:
        """The shape of every design that could be built; none where all have that of the start."""
        blade = self.designs.entry.blade
        if not self.designs.blade_varies:
            return []
        names = (name for number in self.rounds for name in self._built(number))
        return [paths.fill(paths.GEOMETRY, member=member_part(name), blade=blade) for name in names]

    def entries(self, wildcards: Any) -> dict[str, Any]:
        """Entries of blades.yaml that the designs start at, as plain values: bases first, the start with its table last.

        None where no variable is of the blade.
        """
        if not self.designs.blade_varies:
            return {}
        entries, chain = self.sweep.settings.designs.entries, [self.designs.entry.blade]
        while (base := getattr(entries[chain[0]], "base", None)) is not None:
            chain.insert(0, base)
        plain = {name: entries[name].model_dump(exclude_none=True, exclude_unset=True) for name in chain}
        if (table := plain[chain[-1]].pop("stacking_table", None)) is not None:
            plain[chain[-1]]["sweep_lean"] = stacking_table_rows(self.sweep.settings.root / table, chain[-1])
        return plain

    def scene_entries(self, wildcards: Any) -> dict[str, Any]:
        """Entries of scenes.yaml that the designs start at, as plain values; none where no variable is of scenes."""
        if not any(self.varied_in_scenes(wildcards).values()):
            return {}
        entries = self.sweep.settings.scene_designs.entries
        return {scene: entries[scene].model_dump(exclude_none=True, exclude_unset=True) for scene in self.designs.scenes}

    def varied_in_scenes(self, wildcards: Any) -> dict[str, list[str]]:
        """Scene -> variables that are of numbers which it has."""
        designs = self.designs
        return {
            scene: [number.name for number in designs.numbers if scene in designs.values_in_scenes(number)]
            for scene in designs.scenes
        }


def samples_of(settings: Settings, results: Path) -> Callable[[str], Mapping[Pair, Sample]]:
    """Design -> its runs, in the settings' search: of one that a round in `results` has proposed, or of the start."""
    # a round that is made anew may give the name to other values
    samples = cache(designs_of(settings).samples)
    return lambda design: samples(design, values_of(results, design))


def values_of(results: Path, design: str) -> tuple[float, ...] | None:
    """Values of a design's variables, as the round that proposed it has them; None of the start, which has its own."""
    if design == START:
        return None
    files = (paths.fill(ROUND, round=number).replace("<results>", str(results)) for number in count())
    return next(new[design] for new in (round_of(file).new for file in files) if design in new)


def round_of(file: str) -> SearchRound:
    """Content of the file of a round, read once as long as it is the same. Raises InputFileError for a damaged one."""
    path = Path(file)
    return _round_of(file, path.stat().st_mtime_ns if path.exists() else 0)


@cache
def _round_of(file: str, _time: int) -> SearchRound:
    return read_round(file)


def _once(sweep: Sweep) -> paths.Wildcards:
    return [{}] if is_asked(sweep.settings) else []


def targets(sweep: Sweep) -> dict[str, paths.Wildcards]:
    """The dataset, the table and the best designs."""
    # files that an earlier search has left
    left = () if is_asked(sweep.settings) else (ROUND, BUILT, SHAPE, MEASURES)
    return dict.fromkeys((DATASET, TABLE, BEST, *left), _once(sweep))


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
    later=samples_of,
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
    panel=Panel(DATASET, "search.panel.search_contents", "search/panel.js"),
)
