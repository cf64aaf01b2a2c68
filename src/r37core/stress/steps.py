"""Steps of the workflow (docs/architecture.md): the stress per motion of a blade."""

from typing import Any

from r37core.base.plain import from_plain
from r37core.fem.material import Material
from r37core.rom.rom_file import read_reduced_model

from .operator import write_stress_operators
from .recovery import stress_operators


def stress_operator(input: Any, output: Any, params: Any) -> None:
    """Prepare the stress of a blade for simulations. Input: rom. Params: material. Output: stress (npz).

    Raises ValueError where the region that decides has no elements.
    """
    material = from_plain(Material, params.material)
    write_stress_operators(stress_operators(read_reduced_model(input.rom), material), output.stress)
