"""rms.nc, spectrum.nc, stress.nc, fatigue.nc, wear.nc, casing.nc: all responses of a sweep, joined slab by slab."""

from collections.abc import Mapping
from pathlib import Path
from typing import Final

import numpy as np
import xarray as xr
from xarray import Dataset

from r37core.base.dataset_file import attributes_of, joined_hash
from r37core.base.io import InputFileError
from r37core.time_integration.status import RunStatus

from .joining import Along, join
from .measures import ran
from .regions import judged
from .variables import DATASETS, FLAGS

FURTHER_RUNS: Final = "further_runs"
"""Name of the joined dataset of a verdict's further runs from rest (requirements.looks)."""


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


def response_of(datasets: Mapping[str, Dataset], blade: str, scene: str, region: str = "") -> Dataset:
    """One blade in one scene of the joined datasets as its response: their variables, over the speeds that it was run at.

    Its stress is that in a `region`, by default the one that decides. `datasets` by the keys of DATASETS, rms among them;
    others are left aside, and those without this blade and scene. FURTHER_RUNS, which have the stress in the region that
    decides alone, stand in place of runs there.
    """
    parts = [_runs(datasets[kind], blade, scene, region) for kind in DATASETS if kind in datasets]
    response = xr.merge([part for part in parts if part.sizes["speed"]] or parts[:1], compat="override", join="exact")
    further = _runs(datasets.get(FURTHER_RUNS), blade, scene)
    if region or not further.sizes["speed"]:
        return response
    joined = overlaid(response, further)
    # what further runs do not have is that of the sweep, and NaN at speeds of theirs alone
    rest = response.reset_coords(drop=True).drop_vars(joined.data_vars, errors="ignore").reindex(speed=joined["speed"])
    return xr.merge([joined, rest], join="outer")


def response_in_operation(datasets: Mapping[str, Dataset], blade: str, scene: str) -> Dataset:
    """The response that a verdict judges in operation: its further runs alone, where there are any."""
    further = _runs(datasets.get(FURTHER_RUNS), blade, scene)
    return further if further.sizes["speed"] else response_of(datasets, blade, scene)


def with_further_runs(kind: str, dataset: Dataset, further: Dataset | None) -> Dataset:
    """A joined dataset of a `kind`, or its part of a blade or scene, with a verdict's further runs in place of the sweep's."""
    if further is None or "status" not in further:
        return dataset
    missing = [name for name in ("blade", "scene") if name not in dataset.dims]
    datasets = {kind: dataset.expand_dims(missing), FURTHER_RUNS: further.expand_dims(missing)}
    joined = dataset.expand_dims(missing)
    responses = [
        response_of(datasets, blade, scene).expand_dims(blade=[blade], scene=[scene])
        for blade in joined["blade"].values
        for scene in joined["scene"].values
    ]
    whole = xr.merge(responses, join="outer", compat="no_conflicts", combine_attrs="override").assign_attrs(dataset.attrs)
    whole["status"] = whole["status"].fillna(RunStatus.NOT_RUN).astype("i1")
    return whole.sel({name: joined[name] for name in ("blade", "scene")}).isel(dict.fromkeys(missing, 0))


def _runs(dataset: Dataset | None, blade: str, scene: str, region: str = "") -> Dataset:
    """One blade and scene of a joined dataset, at the speeds that it was run at: none where the dataset does not have it."""
    if dataset is None or "status" not in dataset or not (blade in dataset["blade"] and scene in dataset["scene"]):
        return Dataset(coords={"speed": []})
    part = dataset.sel(blade=blade, scene=scene, drop=True)
    part = part.sel(region=region, drop=True) if region and "region" in part.dims else judged(part)
    return ran(part)


def overlaid(below: Dataset, above: Dataset) -> Dataset:
    """Runs `below` with those of `above` in place of them where these are, over the speeds of both and no other coordinate."""
    below, above = (runs.reset_coords(drop=True) for runs in (below, above))
    kept = below.isel(speed=np.flatnonzero(~np.isin(below["speed"].values, above["speed"].values)))
    # motions of all scenes have the numbers of a lining, and a bare casing's runs have none
    over_speeds = [str(name) for name in above.data_vars if "speed" in above[name].dims and name in below]
    joined = xr.concat([kept[over_speeds], above[over_speeds]], "speed", join="outer").sortby("speed")
    return joined.assign(above.drop_dims("speed").data_vars)
