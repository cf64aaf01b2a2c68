"""Members of samples, each a blade and a scene with runs of its own. The nominal sweep is a sample of one member."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache, cached_property
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    # jobs unpickle what stands beside this
    from r37core.config import BladeSettings, Settings
    from r37core.contact.scene import Scene

Pair = tuple[str, str]
"""Blade and scene."""

NOMINAL = ""
"""Name of the one member of the nominal sweep, whose files lie in no folder of their own."""


@dataclass(frozen=True)
class Member:
    """A blade and a scene as runs have them. `model`: part `member` of the paths of the model that they start from."""

    blade: BladeSettings
    scene: Scene
    model: str = NOMINAL


@dataclass(frozen=True)
class Sample:
    """Members of one blade and scene, by name, that are all run at the same speeds.

    `deciding`: those of them that adaptive speeds are decided by, at most at `largest_share` of the finest grid. `results`:
    what is wanted of each run. `history_speeds` (rad/s): where the stress is kept for every revolution. `campbell`: part
    `member` of the path of the Campbell diagram that adaptive speeds begin with.
    """

    members: Mapping[str, Member]
    deciding: Sequence[str]
    largest_share: float
    results: tuple[str, ...]
    history_speeds: tuple[float, ...] = ()
    campbell: str = NOMINAL


@dataclass(frozen=True)
class Sampling:
    """Samples of an extension, whose members are run like the sweep.

    `samples`: members by blade and scene; none where the settings ask for none. What is made of them stands in the tables of
    all blades: `ranges`, a table as of results/ranges.py, in the summary; `dataset`, with a dimension `member`, in the ranking
    and the explorer.
    """

    samples: Callable[[Settings], Mapping[Pair, Sample]]
    ranges: str
    dataset: str


class Beside(dict[str, Mapping[Pair, Sample]]):
    """Samples by the folder that they lie in, and those of folders that are named while a run goes on.

    `later`: first part of such a folder -> the samples of the part after it, as of `search/d0012`. What counts samples before
    a run, and goes through them, meets those that are known.
    """

    def __init__(self, known: Mapping[str, Mapping[Pair, Sample]], later: Mapping[str, Callable[[str], Mapping[Pair, Sample]]]):
        super().__init__(known)
        self.later = later

    def __missing__(self, folder: str) -> Mapping[Pair, Sample]:
        first, _, name = folder.partition("/")
        return self.later[first](name)


@dataclass(frozen=True)
class Samples:
    """All members that are run: the nominal ones, and those of samples `beside` them, by the folder that these lie in.

    Methods with `wildcards` take those of rules, with or without a `member`. That is the part of a path before the blade:
    `folder/name/` of a member, `folder/` of what its sample has together, and nothing of the nominal ones. Names begin with a
    digit, folders and their parts with a letter.
    """

    settings: Settings
    beside: Mapping[str, Mapping[Pair, Sample]] = field(default_factory=dict)

    @property
    def pattern(self) -> str:
        """Pattern of the wildcard `member`."""
        later = [rf"{first}/[a-z][^/]*" for first in getattr(self.beside, "later", ())]
        return rf"(?:(?:{'|'.join([*self.beside, *later])})/(?:\d[^/]*/)?)?"

    def sample(self, wildcards: Any) -> Sample:
        """Sample of a blade and scene that has the member."""
        (folder, _), pair = folder_and_name(wildcards), (wildcards.blade, wildcards.scene)
        return self.beside[folder][pair] if folder else self._nominal(pair)

    def member(self, wildcards: Any) -> Member:
        """Member of a blade and scene."""
        return self.sample(wildcards).members[folder_and_name(wildcards)[1]]

    def blade(self, wildcards: Any) -> BladeSettings:
        """The blade of a member, which is the same in all scenes."""
        folder, name = folder_and_name(wildcards)
        if not folder:
            return self.settings.blades[wildcards.blade]
        blade_samples = (sample for (blade, _), sample in self.beside[folder].items() if blade == wildcards.blade)
        return next(sample.members[name].blade for sample in blade_samples if name in sample.members)

    @cached_property
    def _nominal(self) -> Any:
        return cache(self._nominal_of)

    def _nominal_of(self, pair: Pair) -> Sample:
        settings, (blade, scene) = self.settings, pair
        chosen, results = settings.scenes[scene], settings.results_of(blade, scene)
        return Sample(
            members={NOMINAL: Member(settings.blades[blade], chosen.scene)},
            deciding=[NOMINAL],
            largest_share=settings.config.refinement.scene_refinement(chosen.scene).largest_share,
            results=results,
            history_speeds=chosen.stress_history_speeds if "stress" in results else (),
        )


def member_of(wildcards: Any) -> str:
    """The part `member` of a path; that of the nominal ones where a rule has none."""
    return getattr(wildcards, "member", NOMINAL)


def folder_and_name(wildcards: Any) -> tuple[str, str]:
    """Folder and name of a member; both empty of a nominal one."""
    parts = member_of(wildcards).split("/")[:-1]
    named = bool(parts) and parts[-1][0].isdigit()
    return "/".join(parts[:-1] if named else parts), parts[-1] if named else NOMINAL


def path_part(folder: str, name: str = NOMINAL) -> str:
    """The part `member` of a path: of a member, without a name of its sample, and of the nominal ones without a folder."""
    return "".join(f"{part}/" for part in (folder, name) if part)
