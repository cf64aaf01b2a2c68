"""rom.nc: the reduced model of one blade."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from xarray import Dataset

from r37core.base.dataset_file import read_dataset, write_dataset
from r37core.base.io import readable
from r37core.base.variable import about

from .disc_modes import DiscModes
from .logarithmic_stiffness import LogarithmicStiffness
from .quadratic_terms import QuadraticTerms
from .recovery_nodes import RecoveryNodes
from .reduced_model import ReducedModel
from .stress_region import StressRegion

_SQUARE = ("row", "column")
_ARRAYS = {
    "stiffness": (_SQUARE, "N m-1", "reduced elastic stiffness"),
    "geometric_stiffness": (_SQUARE, "N m-1 s2 rad-2", "reduced geometric stiffness per squared speed"),
    "mass": (_SQUARE, "kg", "reduced mass"),
    "spin_softening": (_SQUARE, "kg", "reduced spin softening per squared speed"),
    "contact_chord": (("contact_node",), "1", "chord fraction of the contact nodes"),
    "contact_tip_lengths": (("contact_node",), "m", "length of tip along the casing's meridian of each contact node"),
    "shape_products": (("shape", "column"), "kg1/2", "mass product with ideal shapes"),
    "shape_norms": (("shape",), "kg1/2", "mass norm of the ideal shapes"),
    "rotation_stiffening": (("rotation_shape",), "s2 rad-2", "relative stiffening of these shapes per squared speed"),
    "singular_values": (("basis_column",), "1", "singular values of the basis columns"),
}
_LARGE = tuple(f"large_mode_{number}" for number in range(4))
_WAVE = ("nodal_diameter", "disc_mode", "disc_column")
_PARTS: dict[str, tuple[str, type, dict[str, tuple[tuple[str, ...], str, str]]]] = {
    "logarithmic": (
        "logarithmic_stiffness",
        LogarithmicStiffness,
        {
            "linear": (
                _SQUARE,
                "kg",
                "change of the logarithm of the stiffness with the logarithm of 1 + rate times the squared speed",
            ),
            "quadratic": (_SQUARE, "kg", "change with the square of that"),
            "speeds": (("exact_speed",), "rad s-1", "speeds it is exact at"),
            "rate": ((), "s2 rad-2", "rate of that logarithm"),
        },
    ),
    "quadratic": (
        "quadratic",
        QuadraticTerms,
        {
            "coordinates": (
                ("large_mode_0", "column"),
                "kg1/2",
                "mass product with the modes that have displacements of second order",
            ),
            "derivatives": (("power", "mode_pair", "column"), "1", "mass product with the static derivatives of these modes"),
            "cubic": (
                ("power", *_LARGE),
                "s-2 m-2 kg-1",
                "stiffness of third order of these modes where all others follow at once",
            ),
            "height": ((), "m", "height of the blade"),
            "path_errors": (("path_share",), "m", "error of the tip's path against full finite elements"),
        },
    ),
    "disc": (
        "disc",
        DiscModes,
        {
            "squared_frequencies": (("nodal_diameter", "disc_mode"), "rad2 s-2", "squared frequencies at rest"),
            "stiffness_per_square": (
                ("part", *_WAVE),
                "rad-2",
                "change of the stiffness per squared speed, real and imaginary",
            ),
            "likeness": (("part", *_WAVE), "1", "mass product with modes of the highest nodal diameter"),
            "shape_products": (("part", "shape", "disc_mode"), "kg1/2", "mass product of ideal shapes with these"),
            "highest_modes": (("column", "disc_mode"), "kg-1/2", "modes of the highest nodal diameter"),
            "sectors": ((), "1", "number of sectors"),
        },
    ),
}
"""Beginning of the names of variables -> field of the model, its class, and its fields."""

_OF_NODES: dict[str, tuple[tuple[str, ...], str, str]] = {
    "nodes": ((), "1", "mesh node numbers"),
    "points": (("axis",), "m", "coordinates"),
    "basis": (("axis", "column"), "1", "displacement per coordinate"),
    "rotation_shapes": (("axis", "rotation_shape"), "m s2 rad-2", "shapes of the displacement by rotation"),
}
_REGION = "stress_"


def write_reduced_model(model: ReducedModel, file: Path | str, provenance: Mapping[str, object] | None = None) -> None:
    """Write the model; terms that it lacks are absent from the file."""
    data = _variables("", model, _ARRAYS)
    node_groups = {f"tip_{line}": nodes for line, nodes in model.tip_lines.items()}
    node_groups |= {"contact": model.contact_nodes}
    node_groups |= {_REGION + name: region.nodes for name, region in model.stress_regions.items()}
    if model.whole_blade is not None:
        node_groups["blade"] = model.whole_blade
    for group, recovery in node_groups.items():
        for part, (axes, units, text) in _OF_NODES.items():
            content = getattr(recovery, part), about(units, f"{text} ({group})")
            data[f"{group}_{part}"] = ((f"{group}_node", *axes), *content)
    for name, region in model.stress_regions.items():
        prefix = _REGION + name
        texts = {"description": region.description, "highest_frequency": region.highest_frequency}
        texts |= {"integration_points": int(region.integration_points)}
        evaluated = about("1", "places of the evaluated nodes, or integration points, among those of the elements") | texts
        data[f"{prefix}_evaluated"] = f"{prefix}_evaluated_node", region.evaluated, evaluated
        places = about("1", "chord, span and thickness of the evaluated nodes or integration points")
        data[f"{prefix}_places"] = (f"{prefix}_evaluated_node", "parameter"), region.places, places
        for kind, elements in region.elements.items():
            dims, described = (f"{prefix}_{kind}", f"node_of_{kind}"), about("1", f"elements of type {kind} ({prefix})")
            data[f"{prefix}_elements_{kind}"] = dims, elements, described
    for group, (field, _, table) in _PARTS.items():
        data |= _variables(f"{group}_", getattr(model, field), table)
    attributes = {
        "basis_columns": len(model.singular_values),
        "basis_independent_columns": model.size,
        "basis_tolerance": model.tolerance,
        "quadratic_residual": model.quadratic_residual,
        "tip_line_names": list(model.tip_lines),
        "stress_region_names": " ".join(model.stress_regions),
        "contact": model.contact,
        "mesh_nodes": model.mesh_nodes,
    }
    dataset = Dataset(data, coords={"shape": list(model.shape_names)}, attrs=attributes)
    write_dataset(dataset, file, provenance)


def read_reduced_model(file: Path | str) -> ReducedModel:
    """The model of a rom.nc; InputFileError when the file cannot be read."""
    dataset = read_dataset(file)
    with readable(file):
        arrays: dict[str, Any] = {name: dataset[name].values for name in _ARRAYS if name in dataset}
        return ReducedModel(
            **arrays,
            contact=str(dataset.attrs["contact"]),
            contact_nodes=_recovery(dataset, "contact"),
            tip_lines={line: _recovery(dataset, f"tip_{line}") for line in np.atleast_1d(dataset.tip_line_names)},
            stress_regions={name: _region(dataset, _REGION + name) for name in dataset.stress_region_names.split()},
            whole_blade=_recovery(dataset, "blade") if "blade_basis" in dataset else None,
            shape_names=tuple(str(name) for name in dataset["shape"].values),
            tolerance=float(dataset.attrs["basis_tolerance"]),
            quadratic_residual=float(dataset.attrs["quadratic_residual"]),
            mesh_nodes=int(dataset.attrs["mesh_nodes"]),
            **{field: _part(dataset, group, kind, table) for group, (field, kind, table) in _PARTS.items()},
        )


def _variables(begin: str, source: Any, table: Mapping[str, tuple[tuple[str, ...], str, str]]) -> dict[str, Any]:
    """Variables of a table from the fields of a source, as xarray takes them; those that are None are left out."""
    return {
        f"{begin}{name}": (dims, value, about(*texts))
        for name, (dims, *texts) in table.items()
        if (value := getattr(source, name, None)) is not None
    }


def _part(dataset: Dataset, group: str, kind: type, table: Mapping[str, Any]) -> Any:
    """The part of the model whose variables begin with `group`; None where it has none."""
    values = {name: dataset[f"{group}_{name}"].values for name in table if f"{group}_{name}" in dataset}
    return kind(**{name: value if value.ndim else float(value) for name, value in values.items()}) if values else None


def _region(dataset: Dataset, group: str) -> StressRegion:
    evaluated, elements = dataset[f"{group}_evaluated"], f"{group}_elements_"
    return StressRegion(
        description=str(evaluated.attrs["description"]),
        highest_frequency=float(evaluated.attrs["highest_frequency"]),
        nodes=_recovery(dataset, group),
        elements={name.removeprefix(elements): dataset[name].values for name in map(str, dataset) if name.startswith(elements)},
        evaluated=evaluated.values,
        places=dataset[f"{group}_places"].values,
        integration_points=bool(evaluated.attrs["integration_points"]),
    )


def _recovery(dataset: Dataset, group: str) -> RecoveryNodes:
    return RecoveryNodes(*(dataset[f"{group}_{part}"].values for part in _OF_NODES))
