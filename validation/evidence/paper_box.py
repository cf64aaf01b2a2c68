"""The paper's region of the stress, in which all that reproduces it is judged."""

import xarray as xr

from r37core.fem.material import Material
from r37core.rom.reduced_model import ReducedModel
from r37core.stress.operator import StressOperator
from r37core.stress.recovery import stress_operators

BOX = "box"
"""Its name in config.yaml."""


def box_part(response: xr.Dataset) -> xr.Dataset:
    """A response with the stress of the box alone."""
    return response.sel(region=BOX, drop=True) if "region" in response.dims else response


def box_operator(model: ReducedModel, material: Material) -> StressOperator:
    """Stress in the box. Raises what stress_operators raises."""
    return stress_operators(model, material)[BOX]
