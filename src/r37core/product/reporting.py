"""Content of the report (snakemake --report): categories by blade, then scene, labels and captions."""

from collections.abc import Mapping
from typing import Any

from r37core.figures.declared import FIGURES as PIPELINE
from r37core.plans.code import CodeHashes
from r37core.plans.extension import Figure
from r37core.plans.sweep_plan import Sweep

from .extensions import EXTENSIONS

TOGETHER = "All blades"
EVERY_SCENE = "every scene"

FIGURES: tuple[Figure, ...] = (*PIPELINE, *(figure for extension in EXTENSIONS for figure in extension.figures))
"""All figures that are drawn from data."""


def drawing(code: CodeHashes, operating: Mapping[str, Any] | None, figure: Figure, sweep: Sweep) -> dict[str, Any]:
    """Parameters of the rule of a figure, with the code of its drawing function alone.

    `operating`: range of speeds that is marked in the figure, as plain values. The caption says where not all blades are drawn.
    """
    arguments, every = figure.arguments(sweep), sweep.settings.blades
    shown = arguments.get("drawn", {}).get("blade", every)
    caption = figure.caption + (f" {len(shown)} of {len(every)} blades are drawn." if len(shown) < len(every) else "")
    return {
        **code.step("figures.steps.draw", figure.draw.rpartition(".")[0]),
        "draw": f"r37core.{figure.draw}",
        "of": _title_parts,
        "caption": lambda wildcards: caption.format(**dict(wildcards.items())),
        **({"operating": operating} if operating else {}),
        **arguments,
    }


def _title_parts(wildcards: Any) -> dict[str, str]:
    """Names of what a figure shows, as its title says it and as datasets have it."""
    values = dict(wildcards.items())
    return {name: values[name] for name in ("family", "blade", "scene") if name in values}
