"""An Abaqus/CalculiX deck of a blade, to check us in another program."""

from pathlib import Path

from r37core.base.io import write_text
from r37core.fem.elements import ELEMENTS
from r37core.fem.material import Material
from r37core.mesh.blade_mesh import NODE_SETS, BladeMesh


def write_abaqus(mesh: BladeMesh, file: Path | str, material: Material, title: str) -> None:
    """Write a complete deck in SI units that asks for the first ten modes; `ccx mesh`, without the suffix, runs it."""
    lines = ["*HEADING", title, "*NODE, NSET=ALL_NODES"]
    for i, point in enumerate(mesh.points.tolist(), start=1):
        # exact where 20 characters suffice: CalculiX reads no more
        texts = (repr(value) if len(repr(value)) <= 20 else f"{value:.17f}"[:20] for value in point)
        lines.append(", ".join([str(i), *texts]))
    first = 1
    for name, elements in mesh.blocks.items():
        lines.append(f"*ELEMENT, TYPE={ELEMENTS[name].abaqus}, ELSET=BLADE")
        for i, nodes in enumerate((elements + 1).tolist(), start=first):
            rows = _rows([i, *nodes], 10)
            lines += [*rows[:-1], rows[-1].rstrip(",")]
        first += len(elements)
    for name in NODE_SETS:
        if len(mesh.node_set(name)):
            lines.append(f"*NSET, NSET={name.upper()}")
            lines += _rows((mesh.node_set(name) + 1).tolist(), 12)
    lines += [
        "*MATERIAL, NAME=BLADE_MATERIAL",
        "*ELASTIC",
        f"{material.youngs_modulus:.12g}, {material.poissons_ratio:.12g}",
        "*DENSITY",
        f"{material.density:.12g}",
        "*SOLID SECTION, ELSET=BLADE, MATERIAL=BLADE_MATERIAL",
        "*BOUNDARY",
        "ROOT, 1, 3",
        "*STEP",
        "*FREQUENCY",
        "10",
        "*NODE FILE",
        "U",
        "*END STEP",
    ]
    write_text("\n".join(lines) + "\n", file)


def _rows(numbers: list[int], width: int) -> list[str]:
    """Rows of at most `width` numbers, each ending with the comma that says that more may follow."""
    return [", ".join(map(str, numbers[i : i + width])) + "," for i in range(0, len(numbers), width)]
