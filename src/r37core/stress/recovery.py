"""The stress operators of a reduced model."""

import numpy as np

from r37core.fem.material import Material
from r37core.fem.stress import nodal_stress
from r37core.rom.reduced_model import ReducedModel
from r37core.rom.stress_region import StressRegion

from .operator import StressOperator, judged_operator


def stress_operators(model: ReducedModel, material: Material) -> dict[str, StressOperator]:
    """Stress in the model's regions, by name, averaged over the region's elements that share a node.

    A region without elements is left out. Raises ValueError where the first one, which decides, has none, and where no mode is
    below a region's highest frequency.
    """
    first = next(iter(model.stress_regions))
    if not model.stress_regions[first].elements:
        raise ValueError(
            f"the stress region {first} ({model.stress_regions[first].description}) has no elements; enlarge it in "
            "structure.stress_regions in config.yaml (of an imported mesh, in its own stress_regions in blades.yaml), or use a "
            "finer mesh"
        )
    return {name: _operator(model, region, material) for name, region in model.stress_regions.items() if region.elements}


def stress_operator(model: ReducedModel, material: Material) -> StressOperator:
    """Stress in the region that decides. Raises what stress_operators raises."""
    return judged_operator(stress_operators(model, material))


def _operator(model: ReducedModel, region: StressRegion, material: Material) -> StressOperator:
    nodes, band = region.nodes, _band(model, region)
    basis = nodes.basis if band is None else nodes.basis @ band[1]
    fields = np.concatenate([basis, nodes.rotation_shapes], axis=2)
    return StressOperator(
        operator=nodal_stress(region.elements, nodes.points, fields, material)[:, region.evaluated],
        coordinates=model.size,
        region=region.description,
        band=None if band is None else band[0],
        is_complete=region.is_complete,
        places=region.places,
    )


def _band(model: ReducedModel, region: StressRegion) -> tuple[np.ndarray, np.ndarray] | None:
    """Amplitudes per coordinate, shape (modes, coordinates), of the modes at rest that count, and their shapes; None: all."""
    if not np.isfinite(region.highest_frequency):
        return None
    frequencies, modes = model.modes(0.0)
    shapes = modes[:, frequencies <= 2.0 * np.pi * region.highest_frequency]
    if not shapes.size:
        raise ValueError(
            f"no mode is below the highest frequency of a stress region ({region.description}); raise its highest_frequency_hz "
            "in structure.stress_regions in config.yaml"
        )
    return shapes.T @ model.mass, shapes
