"""Where the files lie that more than one rule speaks of, as Snakemake's patterns.

`<results>` and `<logs>` are folders of the run; what stands in braces are wildcards. Two underscores separate names.
"""

from __future__ import annotations

from typing import Any

GEOMETRY = "<results>/{blade}/geometry.nc"
MESH = "<results>/{blade}/mesh.vtu"
REDUCED_MODEL = "<results>/{blade}/rom_{tip_line}.nc"
CONTACT_MODEL = "<results>/{blade}/contact_{tip_line}.npz"
CAMPBELL = "<results>/{blade}/campbell.nc"
INTEGRATION_STAMP = "<results>/{blade}/{scene}/time_integration.stamp"
ROUND = "<results>/{blade}/{scene}/round_{round}.json"
SPEED = "<results>/{blade}/{scene}/speed_{speed}.npz"
RESPONSE = "<results>/{blade}/{scene}/response.nc"
CAMPBELL_FIGURE = "<results>/figures/campbell_{blade}.png"
MAP_FIGURE = "<results>/figures/{kind}_{blade}__{scene}.png"
RESPONSE_FIGURE = "<results>/figures/response_{blade}.png"
WATERFALL_FIGURE = "<results>/figures/waterfall_{blade}__{scene}.png"
COMPARISON_FIGURE = "<results>/figures/comparison_{scene}.png"
DESIGNS = "<results>/designs.csv"
DESIGN_FIGURE = "<results>/figures/designs_{family}.png"
EXPORTED_MESH = "<results>/exports/{blade}/mesh.{format}"
EXPORTED_SURFACE = "<results>/exports/{blade}/surface.step"
EXPORTED_MODES = "<results>/exports/{blade}/modes"
EXPORTED_STRESS = "<results>/exports/{blade}/stress_{scene}"
EXPORTED_MATRICES = "<results>/exports/{blade}/matrices"
SIGNALS = "<results>/{blade}/{scene}/signals.nc"
ALL_SIGNALS = "<results>/signals.nc"
SPECTROGRAM_FIGURE = "<results>/figures/spectrogram_{blade}__{scene}.png"
ORDERS_FIGURE = "<results>/figures/orders_{blade}__{scene}.png"
MODE_SHAPES = "<results>/shapes/{blade}/modes"
WORST_SHAPES = "<results>/shapes/{blade}/stress_{scene}"
SHAPES_PAGE = "<results>/shapes/{blade}.html"
MODES_FIGURE = "<results>/figures/shapes_{blade}.png"
WORST_FIGURE = "<results>/figures/shapes_{blade}__{scene}.png"
WHOLE_BLADE_MODEL = "<results>/exports/{blade}/rom_{tip_line}.nc"
STUDY_CASE = "<results>/studies/{study}/{case}.nc"
STUDY_MODEL = "<results>/studies/models/{blade}/{model}/{file}"


def as_pdf(picture: str) -> str:
    """The vector picture beside a PNG."""
    return picture.removesuffix(".png") + ".pdf"


def fill(pattern: str, **wildcards: Any) -> str:
    """The pattern with its wildcards replaced."""
    return pattern.format(**wildcards)
