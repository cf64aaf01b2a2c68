"""An extension: what one capability adds to the pipeline, as plain data. `r37core.product.extensions` names all of them."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from r37core.config import Settings
from r37core.config.section import ExtensionSection

from .paths import Wildcards
from .samples import Pair, Sample, Sampling
from .sweep_plan import Sweep

Targets = Callable[[Sweep], dict[str, Wildcards]]
"""Patterns of files -> the wildcards of each that a run asks for; none where its configuration does without."""


@dataclass(frozen=True)
class Panel:
    """Panel of an extension in the explorer of a run that has its dataset.

    `dataset`: that one file, a dataset or a table, none in a run without it.
    `contents`: function of what it holds, as `folder.module.function`, that gives what JSON can carry.
    `program`: file of this package that draws it (`explorer/panels.js`).
    """

    dataset: Targets
    contents: str
    program: str


@dataclass(frozen=True)
class Extension:
    """One capability: a folder of this package, a file of rules, and a line in the registry.

    `name`: of the folder, of the rule that makes all of it, and of its section of config.yaml.
    `section`: that section; none without one.
    `checks`: what no model of the section alone can check; each raises ConfigError.
    `sampling`: members that it has run beside the sweep, and what is made of them.
    `later`: of samples that are named while a run goes on, by the part of their folder below one of the extension's name; takes
    the folder of the results.
    `simulated`: files of its own simulations in the folders of the blades, which other machines may make.
    `targets`: what is made of them; part of all_blades unless `made_on_request`.
    `motions`: a dataset of more motions at a speed than that from rest (results/other_motions.py), none in a run without it; it
    stands in summary, ranking and the figures of the response.
    `verdict`: a table of requirements and whether blades meet them, none in a run without it; maps of designs show it.
    `remarks`: what a run should say of it before it starts.
    `captions`: kind of figure -> what is seen in it, with names (blade, scene) in braces.
    `panel`: what the explorer shows of it.
    `closing`: function of the folder of the results, as `folder.module.function`, that says in a line what was found; without
    one, how many files were made is said.
    `look_at`: file or folder that a run names first when it ends, as a pattern without wildcards but `<results>`; without one
    the first page, else picture, else table among the targets.
    """

    name: str
    section: ExtensionSection[Any] | None = None
    checks: tuple[Callable[[Settings], None], ...] = ()
    sampling: Sampling | None = None
    later: Callable[[Settings, Path], Callable[[str], Mapping[Pair, Sample]]] | None = None
    simulated: Targets = lambda _: {}
    targets: Targets = lambda _: {}
    motions: Targets = lambda _: {}
    verdict: Targets = lambda _: {}
    remarks: Callable[[Settings], list[str]] = lambda _: []
    captions: Mapping[str, str] = field(default_factory=dict)
    panel: Panel | None = None
    closing: str = ""
    look_at: str = ""
    made_on_request: bool = False

    def all_targets(self, sweep: Sweep) -> dict[str, Wildcards]:
        """All that a run makes of it."""
        return {**self.simulated(sweep), **self.targets(sweep)}
