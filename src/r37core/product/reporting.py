"""Content of the report (snakemake --report): categories by blade, then scene, labels and captions."""

from collections.abc import Callable, Mapping
from typing import Any

from r37core.figures import captions
from r37core.plans.code import CodeHashes

from .extensions import EXTENSIONS

TOGETHER = "All blades"
EVERY_SCENE = "every scene"


def captioned(figure: str | None = None) -> Callable[[Any], str]:
    """The parameter `caption` of a kind of figure, or where none is named of the kind that is a wildcard."""
    return lambda wildcards: caption(figure or wildcards.kind, **dict(wildcards.items()))


def drawing(
    code: CodeHashes, operating: Mapping[str, Any] | None, function: str, figure: str | None = None, **arguments: Any
) -> dict[str, Any]:
    """Parameters of a rule of figures: the `function` of r37core, as `folder.module.function`, and its code alone.

    `operating`: range of speeds that is marked in the figure, as plain values; `arguments`: what the function takes beside the
    datasets; `figure`: the kind that the caption is of, as in `captioned`.
    """
    step = code.step("figures.steps.draw", function.rpartition(".")[0])
    if operating:
        arguments["operating"] = operating
    return {**step, "draw": f"r37core.{function}", "of": _title_parts, "caption": captioned(figure), **arguments}


def _title_parts(wildcards: Any) -> dict[str, str]:
    """Names of what a figure shows, as its title says it and as datasets have it."""
    values = dict(wildcards.items())
    return {name: values[name] for name in ("family", "blade", "scene") if name in values}


CAPTIONS: dict[str, str] = captions.CAPTIONS | {figure.rule: figure.caption for each in EXTENSIONS for figure in each.figures}
"""Kind of figure, of an extension the name of its rule -> text."""


def caption(figure: str, **names: str) -> str:
    """The caption of a kind of figure, with the names (blade, scene, family) of the one at hand."""
    return CAPTIONS[figure].format(**names)
