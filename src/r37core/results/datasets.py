"""rms.nc, spectrum.nc, stress.nc, fatigue.nc, wear.nc, casing.nc: all responses of a sweep, joined slab by slab."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import xarray as xr

from r37core.base.dataset_file import attributes_of, joined_hash
from r37core.base.io import InputFileError
from r37core.time_integration.status import RunStatus

from .joining import Along, join
from .regions import judged, named_region
from .variables import DATASETS, FLAGS


def write_sweep_dataset(
    kind: str, responses: Mapping[tuple[str, str], Path | str], file: Path | str, provenance: Mapping[str, object]
) -> None:
    """Join one kind of result (a key of DATASETS) of the responses, keyed by (blade, scene), into (blade, scene, speed, ...).

    Speeds are the union; where a blade and scene was not run at one, floats are NaN and `status` says not_run. One
    response's slab is in memory at a time. The attribute `contact` says what contact of which blade acts on, and its kinematics
    unless they are linear. Raises InputFileError for a response that cannot be read, and for two of different `numerics`
    (attribute of a response): mesh, integrator and step of a fidelity level.
    """
    attributes = attributes_of(responses.values())
    contacts: dict[str, dict[str, None]] = {}
    first_with: dict[str, Path | str] = {}
    for ((blade, _), response), response_attributes in zip(responses.items(), attributes, strict=True):
        kinds = (response_attributes.get("contact", "unknown"), response_attributes.get("kinematics"))
        contacts.setdefault(", ".join(kind for kind in kinds if kind), {})[blade] = None
        first_with.setdefault(response_attributes.get("numerics", "unknown numerics"), response)
    if len(first_with) > 1:
        (first, earlier), (other, later), *_ = first_with.items()
        raise InputFileError(
            f"{earlier} was made with {first}, {later} with {other}; a dataset holds one fidelity level: "
            "delete the one that is out of date and run again"
        )
    contact = "; ".join(f"{contact}: {', '.join(blades)}" for contact, blades in contacts.items())
    made = {**provenance, "input_hash": joined_hash(attributes), "contact": contact}
    title = f"{kind} of rubbing blades, over blade, scene and speed"
    join(responses, Along(names=("tip_point", *DATASETS[kind], *FLAGS)), file, title, made)


def response_of(datasets: Mapping[str, xr.Dataset], blade: str, scene: str, region: str = "") -> xr.Dataset:
    """One blade in one scene of the joined datasets as its response: their variables, over the speeds that it was run at.

    Its stress is that in a `region`, by default the one that decides. `datasets` by the keys of DATASETS, rms among them;
    others are left aside, and those without this blade and scene.
    """
    parts = []
    for kind in DATASETS:
        if kind in datasets and blade in datasets[kind]["blade"].values and scene in datasets[kind]["scene"].values:
            part = datasets[kind].sel(blade=blade, scene=scene, drop=True)
            part = named_region(part, region) if region and "region" in part.dims else judged(part)
            parts.append(part.isel(speed=np.flatnonzero(part["status"].values != RunStatus.NOT_RUN)))
    return xr.merge([part for part in parts if part.sizes["speed"]] or parts[:1], compat="override", join="exact")
