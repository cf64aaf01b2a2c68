"""rms.nc, spectrum.nc, stress.nc, wear.nc: the responses of all blades and scenes, joined slab by slab."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import netCDF4
import numpy as np

from r37core import __version__
from r37core.io import atomic_write, readable

from .variables import DATASETS, FLAGS, NOT_RUN

_HISTORY = ("max_von_mises_history", "first_yield_revolution")


def write_sweep_dataset(
    kind: str,
    responses: Mapping[tuple[str, str], Path | str],
    file: Path | str,
    provenance: Mapping[str, object],
) -> None:
    """Join one kind of result (a key of DATASETS) of the responses, keyed by (blade, scene), into (blade, scene, speed, ...).

    Speeds are the union; where a blade and scene was not run at one, floats are NaN and `status` says not_run. One
    response's slab is in memory at a time. Raises InputFileError for a response that cannot be read.
    """
    blades = list(dict.fromkeys(blade for blade, _ in responses))
    scenes = list(dict.fromkeys(scene for _, scene in responses))
    with atomic_write(file) as partial, netCDF4.Dataset(partial, "w") as target:
        target.setncatts({"Conventions": "CF-1.11", "r37core_version": __version__})
        target.setncatts({name: str(value) for name, value in provenance.items()})
        axes = _axes(responses)
        _create_axes(target, blades, scenes, axes)
        for (blade, scene), source in responses.items():
            with readable(source), netCDF4.Dataset(source) as response:
                _copy(response, target, kind, (blades.index(blade), scenes.index(scene)), axes)


def _axes(responses: Mapping[tuple[str, str], Path | str]) -> dict[str, np.ndarray]:
    """Union of the speed axes; the other axes are those of the response with the longest one."""
    axes: dict[str, np.ndarray] = {}
    for source in responses.values():
        with readable(source), netCDF4.Dataset(source) as response:
            for name in ("speed", "history_speed", "revolution", "engine_order", "angle", "lobes"):
                if name in response.variables:
                    axes[name] = np.union1d(axes.get(name, np.empty(0)), response[name][:].filled(np.nan))
    return axes


def _create_axes(target: netCDF4.Dataset, blades: Sequence[str], scenes: Sequence[str], axes: Mapping[str, np.ndarray]) -> None:
    for name, labels in (("blade", blades), ("scene", scenes), ("tip_point", ("leading_edge", "trailing_edge"))):
        target.createDimension(name, len(labels))
        target.createVariable(name, str, (name,))[:] = np.array(labels, dtype=object)
    for name, values in axes.items():
        target.createDimension(name, len(values))


def _copy(
    response: netCDF4.Dataset, target: netCDF4.Dataset, kind: str, place: tuple[int, int], axes: Mapping[str, np.ndarray]
) -> None:
    wanted = [*DATASETS[kind], *FLAGS, *(_HISTORY if kind == "stress" else ())]
    for name in wanted:
        if name not in response.variables:
            continue
        source = response[name]
        for dim in source.dimensions:
            if dim in axes and dim not in target.variables:
                axis = target.createVariable(dim, "f8", (dim,), fill_value=False)
                axis.setncatts({key: response[dim].getncattr(key) for key in ("units", "long_name")})
                axis[:] = axes[dim]
        if name not in target.variables:
            fill = np.nan if source.dtype.kind == "f" else False
            created = target.createVariable(name, source.dtype, ("blade", "scene", *source.dimensions), fill_value=fill)
            created.setncatts({key: source.getncattr(key) for key in source.ncattrs() if key != "_FillValue"})
            if name == "status":
                created[:] = NOT_RUN
        rows = [
            np.searchsorted(axes[dim], response[dim][:]) if dim in axes else np.arange(len(target.dimensions[dim]))
            for dim in source.dimensions
        ]
        slab = np.full(target[name].shape[2:], NOT_RUN if name == "status" else np.nan, dtype=source.dtype)
        slab[np.ix_(*rows)] = np.ma.filled(source[:], np.nan) if source.dtype.kind == "f" else source[:]
        target[name][place] = slab
