"""rms.nc, spectrum.nc, stress.nc, fatigue.nc, wear.nc, casing.nc: all responses of a sweep, joined slab by slab."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import xarray as xr
from netCDF4 import Dataset

from r37core.base.dataset_file import Variable, new_netcdf, open_netcdf
from r37core.base.io import InputFileError
from r37core.time_integration.settling import MotionAtEnd
from r37core.time_integration.simulate import TIP_POINTS
from r37core.time_integration.status import MotionKind, RunStatus

from .netcdf import create_axis, create_labels, create_variable
from .variables import AXES, DATASETS, FLAGS

_NOT_RUN: dict[str, int] = {
    "status": RunStatus.NOT_RUN,
    "motion_at_end": MotionAtEnd.UNKNOWN,
    "motion_kind": MotionKind.UNKNOWN,
}
"""Whole numbers of a speed that was not run."""


def write_sweep_dataset(
    kind: str, responses: Mapping[tuple[str, str], Path | str], file: Path | str, provenance: Mapping[str, object]
) -> None:
    """Join one kind of result (a key of DATASETS) of the responses, keyed by (blade, scene), into (blade, scene, speed, ...).

    Speeds are the union; where a blade and scene was not run at one, floats are NaN and `status` says not_run. One
    response's slab is in memory at a time. The attribute `contact` says what contact of which blade acts on. Raises
    InputFileError for a response that cannot be read, and for two of different `numerics` (attribute of a response): mesh,
    integrator and step of a fidelity level.
    """
    blades = list(dict.fromkeys(blade for blade, _ in responses))
    scenes = list(dict.fromkeys(scene for _, scene in responses))
    axes = _axes(responses)
    with new_netcdf(file, provenance) as target:
        for name, labels in (("blade", blades), ("scene", scenes), ("tip_point", TIP_POINTS)):
            create_labels(target, name, labels)
        contacts: dict[str, dict[str, None]] = {}
        for (blade, scene), source in responses.items():
            with open_netcdf(source) as response:
                contacts.setdefault(getattr(response, "contact", "unknown"), {})[blade] = None
                _copy(response, target, kind, (blades.index(blade), scenes.index(scene)), axes)
        target.setncattr("contact", "; ".join(f"{contact}: {', '.join(of)}" for contact, of in contacts.items()))


def response_of(datasets: Mapping[str, xr.Dataset], blade: str, scene: str) -> xr.Dataset:
    """One blade in one scene of the joined datasets as its response: their variables, over the speeds that it was run at.

    `datasets` by the keys of DATASETS, rms among them; others are left aside, and those without this blade and scene.
    """
    parts = []
    for kind in DATASETS:
        if kind in datasets and blade in datasets[kind]["blade"].values and scene in datasets[kind]["scene"].values:
            part = datasets[kind].sel(blade=blade, scene=scene, drop=True)
            parts.append(part.isel(speed=np.flatnonzero(part["status"].values != RunStatus.NOT_RUN)))
    return xr.merge([part for part in parts if part.sizes["speed"]] or parts[:1], compat="override", join="exact")


def _axes(responses: Mapping[tuple[str, str], Path | str]) -> dict[str, np.ndarray]:
    """Union of each numeric axis over the responses, all of the same numerics."""
    axes: dict[str, np.ndarray] = {}
    first_with: dict[str, Path | str] = {}
    for source in responses.values():
        with open_netcdf(source) as response:
            first_with.setdefault(getattr(response, "numerics", "unknown numerics"), source)
            for name in AXES.keys() & response.variables.keys():
                axes[name] = np.union1d(axes.get(name, np.empty(0)), response[name][:].filled(np.nan))
    if len(first_with) > 1:
        (first, file), (other, another), *_ = first_with.items()
        raise InputFileError(
            f"{file} was made with {first}, {another} with {other}; a dataset holds one fidelity level: "
            "delete the one that is out of date and run again"
        )
    return axes


def _copy(response: Dataset, target: Dataset, kind: str, pair: tuple[int, int], axes: Mapping[str, np.ndarray]) -> None:
    for name in (*DATASETS[kind], *FLAGS):
        if name not in response.variables:
            continue
        source = response[name]
        for dim in source.dimensions:
            if dim in axes and dim not in target.variables:
                create_axis(target, dim, axes[dim], AXES[dim])
        if name not in target.variables:
            attributes = {key: source.getncattr(key) for key in source.ncattrs() if key != "_FillValue"}
            dtype = "str" if source.dtype is str else source.dtype.str
            variable = Variable(source.dimensions, attributes.pop("units"), attributes.pop("long_name"), dtype)
            created = create_variable(target, name, variable, ("blade", "scene"), **attributes)
            if name in _NOT_RUN:
                created[:] = _NOT_RUN[name]
        if source.dtype is str:
            target[name][pair] = source[...]
            continue
        rows = [
            np.searchsorted(axes[dim], response[dim][:]) if dim in axes else np.arange(len(target.dimensions[dim]))
            for dim in source.dimensions
        ]
        slab = np.full(target[name].shape[2:], _NOT_RUN.get(name, np.nan), dtype=source.dtype)
        slab[np.ix_(*rows)] = np.ma.filled(source[:], np.nan) if source.dtype.kind == "f" else source[:]
        target[name][pair] = slab
