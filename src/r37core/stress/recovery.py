"""The stress operator of a reduced model."""

from r37core.fem.material import Material
from r37core.fem.stress import nodal_stress
from r37core.rom.reduced_model import ReducedModel

from .operator import StressOperator


def stress_operator(model: ReducedModel, material: Material) -> StressOperator:
    """Stress at the nodes of the model's stress submesh, averaged over the submesh elements that share a node.

    Raises ValueError when the submesh has no elements.
    """
    if not model.stress_elements:
        raise ValueError(
            f"the stress submesh ({model.stress_region}) has no elements; enlarge structure.stress_submesh in config.yaml (of "
            "an imported mesh, its own stress_submesh in blades.yaml), or use a finer mesh"
        )
    submesh = model.stress_submesh
    operator = nodal_stress(model.stress_elements, submesh.points, submesh.fields, material)
    return StressOperator(operator, submesh.basis.shape[2], model.stress_region)
