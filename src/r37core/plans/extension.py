"""An extension: what one capability adds to the pipeline, as plain data. `r37core.product.extensions` names all of them."""

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any, Literal

from r37core.config import Settings
from r37core.config.section import ExtensionSection
from r37core.results.columns import Column

from .extent import Pair, Runs
from .paths import Wildcards
from .sweep_plan import Sweep

Targets = Callable[[Sweep], dict[str, Wildcards]]
"""Patterns of files -> the wildcards of each that a run asks for; none where its configuration does without."""


@dataclass(frozen=True)
class AddedColumns:
    """Columns that an extension adds to a table of the pipeline.

    `table`: summary or ranking; `file`: that one of the extension's targets from which they are made.
    `function`: as `package.module.function`, of the table and the path of that file, that gives the table with the `columns`.
    """

    table: Literal["summary", "ranking"]
    file: str
    function: str
    columns: tuple[Column, ...]


@dataclass(frozen=True)
class Panel:
    """Panel of an extension in the explorer of a run that has its table.

    `table`: that one file among the targets; `shown`: whether a run that makes it has the panel.
    `contents`: function of what it holds, as `package.module.function`, that gives what JSON can carry.
    `program`: file in `src` that draws it (`explorer/panels.js`).
    """

    table: str
    contents: str
    program: str
    shown: Callable[[Sweep], bool] = lambda _: True


@dataclass(frozen=True, kw_only=True)
class Figure:
    """Figure, from which its rule, its targets and its entry in the report follow.

    `rule`: name of its rule; `name`: of its files, with wildcards in braces; `runs`: these wildcards.
    `draw`: function, as `package.module.function`, that takes what the `files` hold and `arguments`, which may be functions of
    wildcards; of title, blade, scene and family those that it names.
    `files`: a pattern each, or a function of the plan and the wildcards, which gives an empty list for none.
    `label`: name in the report; `caption`: what is seen, with names (blade, scene, family) in braces.
    `category`: in the report; without one its blade, or all of them.
    `offered`: files of extensions that it takes, too (product.targets.offered).
    `over_speed`: whether an axis may be of speeds, on which the operating range is marked; else another range redraws nothing.
    """

    rule: str
    name: str
    runs: Callable[[Sweep], Wildcards] = lambda _: [{}]
    draw: str
    files: Mapping[str, str | Callable[[Sweep, Any], str | list[str]]]
    label: str
    caption: str
    category: str = ""
    arguments: Callable[[Sweep], Mapping[str, Any]] = lambda _: {}
    offered: tuple[str, ...] = ()
    over_speed: bool = True

    def targets(self, sweep: Sweep) -> dict[str, Wildcards]:
        """Files of the figure, as PNG and PDF."""
        runs = self.runs(sweep)
        return {f"<results>/figures/{self.name}.{suffix}": runs for suffix in ("png", "pdf")}

    def inputs(self, sweep: Sweep) -> dict[str, Any]:
        """Inputs of the rule of the figure."""
        return {name: partial(file, sweep) if callable(file) else file for name, file in self.files.items()}

    def constraints(self, sweep: Sweep) -> dict[str, str]:
        """Patterns of the wildcards that are neither blade nor scene."""
        names = [name for name in re.findall(r"{(\w+)}", self.name) if name not in ("blade", "scene")]
        return {name: "|".join(run[name] for run in self.runs(sweep)) or "none" for name in names}


@dataclass(frozen=True)
class Extension:
    """One capability: a folder of r37studies, a file of rules, and a line in its registry.

    `name`: of the folder, of the rule that makes all of it, and of its section of config.yaml. A folder may have `EXTENSIONS`
    in place of one, each with a name of its own, which share its file of rules.
    `section`: that section; none without one.
    `checks`: what no model of the section alone can check; each raises ConfigError.
    `runs`: its simulations beside those of the sweep, by blade and scene.
    `targets`: what is made of it; part of all_blades unless `made_on_request`.
    `columns`: what it adds to summary.csv and ranking.csv.
    `offers`: files among the targets, by names under which other rules take them where a run makes them. The pipeline takes
    `motions`, more than that from rest (results/other_motions.py), for the figures of the response; `members`, a dataset with a
    dimension `member`, for the ranking; and `further_runs`, from rest, in place of the sweep's (results/datasets.py).
    `remarks`: what a run should say of it before it starts.
    `figures`: what is drawn of them, made with the targets.
    `panel`: what the explorer shows of it.
    `closing`: function of the folder of the results, as `package.module.function`, that says in a line what was found; without
    one, how many files were made is said.
    `look_at`: file or folder that a run names first when it ends, as a pattern without wildcards but `<results>`; without one
    the first page, else picture, else table among the targets.
    """

    name: str
    section: ExtensionSection[Any] | None = None
    checks: tuple[Callable[[Settings], None], ...] = ()
    runs: Callable[[Settings], Mapping[Pair, Runs]] = lambda _: {}
    targets: Targets = lambda _: {}
    columns: tuple[AddedColumns, ...] = ()
    offers: Mapping[str, str] = field(default_factory=dict)
    remarks: Callable[[Settings], list[str]] = lambda _: []
    figures: tuple[Figure, ...] = ()
    panel: Panel | None = None
    closing: str = ""
    look_at: str = ""
    made_on_request: bool = False

    def all_targets(self, sweep: Sweep) -> dict[str, Wildcards]:
        """All that a run makes of it."""
        targets = dict(self.targets(sweep))
        for figure in self.figures:
            targets |= figure.targets(sweep)
        return targets

    def simulated(self, sweep: Sweep) -> dict[str, Wildcards]:
        """Targets in folders of a blade and scene: its own simulations, which other machines may make."""
        return {pattern: runs for pattern, runs in self.targets(sweep).items() if "{blade}/{scene}/" in pattern}
