"""rom.nc: the reduced model of one blade."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from r37core.base.dataset_file import about, read_dataset, write_dataset
from r37core.base.io import readable

from .reduced_model import CORIOLIS_TERM, RecoveryNodes, ReducedModel

_SQUARE = ("row", "column")
_ARRAYS = {
    "stiffness": (_SQUARE, "N m-1", "reduced elastic stiffness"),
    "geometric_stiffness": (_SQUARE, "N m-1 s2 rad-2", "reduced geometric stiffness per squared speed"),
    "mass": (_SQUARE, "kg", "reduced mass"),
    "spin_softening": (_SQUARE, "kg", "reduced spin softening per squared speed"),
    "coriolis": (_SQUARE, "kg", f"reduced Coriolis matrix G per speed, skew-symmetric: {CORIOLIS_TERM}"),
    "contact_chord": (("contact_node",), "1", "chord fraction of the contact nodes"),
    "contact_tip_lengths": (("contact_node",), "m", "length of tip along the casing's meridian of each contact node"),
    "shape_products": (("shape", "column"), "kg1/2", "mass product with ideal shapes"),
    "shape_norms": (("shape",), "kg1/2", "mass norm of the ideal shapes"),
    "rotation_stiffening": (("rotation_shape",), "s2 rad-2", "relative stiffening of these shapes per squared speed"),
    "singular_values": (("basis_column",), "1", "singular values of the basis columns"),
}
_OF_NODES: dict[str, tuple[tuple[str, ...], str, str]] = {
    "nodes": ((), "1", "mesh node numbers"),
    "points": (("axis",), "m", "coordinates"),
    "basis": (("axis", "column"), "1", "displacement per coordinate"),
    "rotation_shapes": (("axis", "rotation_shape"), "m s2 rad-2", "shapes of the displacement by rotation"),
}
_ELEMENTS = "stress_elements_"


def write_reduced_model(model: ReducedModel, file: Path | str, provenance: Mapping[str, object] | None = None) -> None:
    """Write the model; terms that it lacks are absent from the file."""
    arrays = {name: array for name in _ARRAYS if (array := getattr(model, name)) is not None}
    data: dict = {name: (_ARRAYS[name][0], array, about(*_ARRAYS[name][1:])) for name, array in arrays.items()}
    node_groups = {f"tip_{line}": nodes for line, nodes in model.tip_lines.items()}
    node_groups |= {"contact": model.contact_nodes, "stress": model.stress_submesh}
    if model.whole_blade is not None:
        node_groups["blade"] = model.whole_blade
    for group, recovery in node_groups.items():
        for part, (axes, units, text) in _OF_NODES.items():
            content = getattr(recovery, part), about(units, f"{text} ({group})")
            data[f"{group}_{part}"] = ((f"{group}_node", *axes), *content)
    for name, elements in model.stress_elements.items():
        dims = (f"stress_{name}", f"node_of_{name}")
        data[_ELEMENTS + name] = (dims, elements, about("1", f"submesh elements of type {name}"))
    attributes = {
        "basis_columns": len(model.singular_values),
        "basis_independent_columns": model.size,
        "basis_tolerance": model.tolerance,
        "quadratic_residual": model.quadratic_residual,
        "tip_line_names": list(model.tip_lines),
        "stress_region": model.stress_region,
        "contact": model.contact,
    }
    dataset = xr.Dataset(data, coords={"shape": list(model.shape_names)}, attrs=attributes)
    write_dataset(dataset, file, provenance)


def read_reduced_model(file: Path | str) -> ReducedModel:
    """The model of a rom.nc; InputFileError when the file cannot be read."""
    dataset = read_dataset(file)
    with readable(file):
        elements = [name for name in map(str, dataset) if name.startswith(_ELEMENTS)]
        arrays: dict[str, Any] = {name: dataset[name].values for name in _ARRAYS if name in dataset}
        return ReducedModel(
            **arrays,
            contact=str(dataset.attrs["contact"]),
            contact_nodes=_recovery(dataset, "contact"),
            tip_lines={line: _recovery(dataset, f"tip_{line}") for line in np.atleast_1d(dataset.tip_line_names)},
            stress_submesh=_recovery(dataset, "stress"),
            stress_elements={name.removeprefix(_ELEMENTS): dataset[name].values for name in elements},
            stress_region=str(dataset.attrs["stress_region"]),
            whole_blade=_recovery(dataset, "blade") if "blade_basis" in dataset else None,
            shape_names=tuple(str(name) for name in dataset["shape"].values),
            tolerance=float(dataset.attrs["basis_tolerance"]),
            quadratic_residual=float(dataset.attrs["quadratic_residual"]),
        )


def _recovery(dataset: xr.Dataset, group: str) -> RecoveryNodes:
    return RecoveryNodes(*(dataset[f"{group}_{part}"].values for part in _OF_NODES))
