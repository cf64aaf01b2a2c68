"""The page docs/gallery.md: every figure, what is seen in it, and what agrees."""

from __future__ import annotations

import xarray as xr

from r37core.figures.captions import caption
from r37core.published import REFERENCE

from .check import score
from .gallery import ITEMS, GalleryData, Item, gallery_checks, of_item, verdict


def gallery_page(data: GalleryData, geometry: xr.Dataset, nodes: int, fidelity: str) -> str:
    """The page docs/gallery.md, with the pictures in a folder of its name."""
    checks = gallery_checks(data, geometry, nodes)
    lines = [
        "# Gallery",
        "",
        "Our counterpart of every result figure of the paper, made by `snakemake gallery` from the default sweep at level "
        f"`{fidelity}` and a few runs beside it. Numbers under a figure are generated; a published one counts as met within "
        "the bound of [validation.md](validation.md), which has the same checks at the published step.",
        "",
        f"{score(checks)} published numbers and statements are met.",
    ]
    for item in ITEMS:
        lines += ["", f"## {item.title}", "", f"![{item.title}](gallery/{item.name}.png)", "", _caption(item, data)]
        lines += ["", verdict(of_item(item, checks))]
    return "\n".join(lines) + "\n"


def _caption(item: Item, data: GalleryData) -> str:
    kind, _, scene = item.name.partition("_")
    if kind == "spectrum":
        return caption(kind, blade=REFERENCE, scene=data.scenes[scene])
    return caption(item.name, blade=REFERENCE)
