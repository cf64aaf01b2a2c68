"""Files that the rule all_blades makes where the configuration asks for it, and what extensions add."""

from collections.abc import Mapping
from typing import Any

from r37core.config.elastic_casings import elastic_casings
from r37core.figures.declared import FIGURES as PIPELINE
from r37core.plans.code import CodeHashes
from r37core.plans.extension import AddedColumns, Figure, Panel
from r37core.plans.paths import Wildcards, filled
from r37core.plans.sweep_plan import KINDS, Sweep
from r37core.results.columns import INTERACTIONS, RANKING

from .extensions import EXTENSIONS


def targets(sweep: Sweep) -> dict[str, Wildcards]:
    """Pattern of files -> wildcards of each that is asked for; none where a configuration does without."""
    targets: dict[str, Wildcards] = {f"<results>/{kind}.nc": [{}] if kind in sweep.kinds else [] for kind in KINDS}
    targets["<results>/ranking.csv"] = [{}]
    targets["<results>/coincidences.csv"] = [{}] if elastic_casings(sweep.settings) else []
    for figure in PIPELINE:
        targets |= figure.targets(sweep)
    for extension in EXTENSIONS:
        if not extension.made_on_request:
            targets |= extension.all_targets(sweep)
    return targets


def tables(sweep: Sweep) -> list[str]:
    """Files of `targets` that are no pictures or pages: what Python opens."""
    return [file for file in filled(targets(sweep)) if not file.startswith("<results>/figures/") and not file.endswith(".html")]


def simulated(sweep: Sweep) -> list[str]:
    """Files of the extensions' own simulations."""
    return [file for extension in EXTENSIONS for file in filled(extension.simulated(sweep))]


def offered(what: str, sweep: Sweep) -> dict[str, str]:
    """File that an extension offers to other rules under that name, as the input of that name; none without one."""
    offering = ((extension, extension.offers[what]) for extension in EXTENSIONS if what in extension.offers)
    files = [file for extension, file in offering if extension.targets(sweep)[file]]
    return {what: files[0]} if files else {}


def added(table: str, sweep: Sweep) -> dict[str, AddedColumns]:
    """Extension -> columns that it adds to summary or ranking in this run, those of the last extension first."""
    each_added = ((extension, added) for extension in reversed(EXTENSIONS) for added in extension.columns)
    return {each.name: added for each, added in each_added if added.table == table and each.targets(sweep)[added.file]}


def links(sweep: Sweep) -> list[dict[str, str]]:
    """Files that the explorer links: label, file, and blade and scene if of one.

    They are the tables of all blades, the pipeline's figures of several blades and those of extensions.
    """
    figures = [("", figure) for figure in PIPELINE if "{blade}" not in figure.name]
    figures += [
        (f"{each.name.replace('_', ' ')}: ", figure)
        for each in EXTENSIONS
        if not each.made_on_request
        for figure in each.figures
    ]
    return [{"label": table, "file": table} for table in ("summary.csv", "ranking.csv")] + [
        {"label": begin + figure.label.format(**run), **run, "file": f"figures/{figure.name.format(**run)}.png"}
        for begin, figure in figures
        for run in figure.runs(sweep)
    ]


def panels(sweep: Sweep) -> dict[str, Panel]:
    """Extension -> its panel, of those that have one in this run."""
    declared = ((extension, extension.panel) for extension in EXTENSIONS if extension.panel)
    return {each.name: panel for each, panel in declared if each.targets(sweep)[panel.table] and panel.shown(sweep)}


_ADDED = [added for extension in EXTENSIONS for added in extension.columns]

COLUMNS = {
    table: (*own, *(column for added in _ADDED if added.table == table for column in added.columns))
    for table, own in (("summary", INTERACTIONS), ("ranking", RANKING))
}
"""Columns that summary.csv and ranking.csv may have: those of the pipeline, and of the extensions."""

TOGETHER = "All blades"
EVERY_SCENE = "every scene"

FIGURES: tuple[Figure, ...] = (*PIPELINE, *(figure for extension in EXTENSIONS for figure in extension.figures))
"""All figures that are drawn from data."""


def drawing(code: CodeHashes, operating: Mapping[str, Any] | None, figure: Figure, sweep: Sweep) -> dict[str, Any]:
    """Parameters of the rule of a figure, with the code of its drawing function alone.

    `operating`: range of speeds that is marked, as plain values. The caption says where not all blades or scenes are drawn.
    """
    arguments, caption = figure.arguments(sweep), figure.caption
    scenes = {"scene": arguments["scenes"]} if "scenes" in arguments else {}
    for kind, shown in (scenes | arguments.get("drawn", {})).items():
        every = getattr(sweep.settings, f"{kind}s")
        caption += f" {len(shown)} of {len(every)} {kind}s are drawn." if len(shown) < len(every) else ""
    return {
        **code.step("r37core.figures.steps.draw", figure.draw.rpartition(".")[0]),
        "draw": figure.draw,
        "of": _title_parts,
        "caption": lambda wildcards: caption.format(**dict(wildcards.items())),
        **({"operating": operating} if operating and figure.over_speed else {}),
        **arguments,
    }


def _title_parts(wildcards: Any) -> dict[str, str]:
    """Names of what a figure shows, as its title says it and as datasets have it."""
    values = dict(wildcards.items())
    return {name: values[name] for name in ("family", "blade", "scene") if name in values}
