"""rom.nc: the reduced model of one blade."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from r37core.dataset_file import about, read_dataset, write_dataset
from r37core.io import readable

from .reduced_model import CORIOLIS_TERM, RecoveryNodes, ReducedModel

_MATRICES = {
    "stiffness": ("N m-1", "reduced elastic stiffness"),
    "geometric_stiffness": ("N m-1 s2 rad-2", "reduced geometric stiffness per squared speed"),
    "mass": ("kg", "reduced mass"),
    "spin_softening": ("kg", "reduced spin softening per squared speed"),
    "coriolis": ("kg", f"reduced Coriolis matrix G per speed, skew-symmetric: {CORIOLIS_TERM}"),
}
_ELEMENTS = "stress_elements_"


def write_reduced_model(model: ReducedModel, file: Path | str, provenance: Mapping[str, object] | None = None) -> None:
    """Write the model; terms that it lacks are absent from the file."""
    matrices = {name: matrix for name in _MATRICES if (matrix := getattr(model, name)) is not None}
    data: dict = {name: (("row", "column"), matrix, about(*_MATRICES[name])) for name, matrix in matrices.items()}
    node_groups = {f"tip_{line}": nodes for line, nodes in model.tip_lines.items()}
    node_groups |= {"contact": model.contact_nodes, "stress": model.stress_submesh}
    if model.whole_blade is not None:
        node_groups["blade"] = model.whole_blade
    for group, recovery in node_groups.items():
        data |= _recovery_variables(group, recovery)
    data |= {
        "contact_chord": ("contact_node", model.contact_chord, about("1", "chord fraction of the contact nodes")),
        "shape_products": (("shape", "column"), model.shape_products, about("kg1/2", "mass product with ideal shapes")),
        "shape_norms": ("shape", model.shape_norms, about("kg1/2", "mass norm of the ideal shapes")),
        "rotation_stiffening": (
            "rotation_shape",
            model.rotation_stiffening,
            about("s2 rad-2", "relative stiffening of these shapes per squared speed"),
        ),
        "singular_values": ("basis_column", model.singular_values, about("1", "singular values of the basis columns")),
    }
    for name, elements in model.stress_elements.items():
        dims = (f"stress_{name}", f"node_of_{name}")
        data[_ELEMENTS + name] = (dims, elements, about("1", f"submesh elements of type {name}"))
    attributes = {
        "basis_columns": model.columns,
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
        matrices: dict[str, Any] = {name: dataset[name].values if name in dataset else None for name in _MATRICES}
        return ReducedModel(
            **matrices,
            contact=str(dataset.attrs["contact"]),
            contact_nodes=_recovery(dataset, "contact"),
            contact_chord=dataset["contact_chord"].values,
            tip_lines={line: _recovery(dataset, f"tip_{line}") for line in np.atleast_1d(dataset.tip_line_names)},
            stress_submesh=_recovery(dataset, "stress"),
            stress_elements={
                name.removeprefix(_ELEMENTS): dataset[name].values for name in map(str, dataset) if name.startswith(_ELEMENTS)
            },
            stress_region=str(dataset.attrs["stress_region"]),
            whole_blade=_recovery(dataset, "blade") if "blade_basis" in dataset else None,
            shape_names=tuple(str(name) for name in dataset["shape"].values),
            shape_products=dataset["shape_products"].values,
            shape_norms=dataset["shape_norms"].values,
            tolerance=float(dataset.attrs["basis_tolerance"]),
            singular_values=dataset["singular_values"].values,
            rotation_stiffening=dataset["rotation_stiffening"].values,
            quadratic_residual=float(dataset.attrs["quadratic_residual"]),
        )


def _recovery_variables(group: str, recovery: RecoveryNodes) -> dict:
    node = f"{group}_node"
    return {
        f"{group}_nodes": (node, recovery.nodes, about("1", f"mesh node numbers ({group})")),
        f"{group}_points": ((node, "axis"), recovery.points, about("m", f"coordinates ({group})")),
        f"{group}_basis": ((node, "axis", "column"), recovery.basis, about("1", f"displacement per coordinate ({group})")),
        f"{group}_rotation_shapes": (
            (node, "axis", "rotation_shape"),
            recovery.rotation_shapes,
            about("m s2 rad-2", f"shapes of the displacement by rotation ({group})"),
        ),
    }


def _recovery(dataset: xr.Dataset, group: str) -> RecoveryNodes:
    return RecoveryNodes(*(dataset[f"{group}_{part}"].values for part in ("nodes", "points", "basis", "rotation_shapes")))
