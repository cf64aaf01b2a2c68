"""Figures of datasets, as the workflow draws them: each function returns a figure of Matplotlib.

Matplotlib's parameters and backend stay those of the caller.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import xarray as xr

from r37core.base.io import function_named
from r37core.base.plain import to_plain
from r37core.config import ConfigError
from r37core.results.regions import judged
from r37studies.designs.table import compared_in

from .run_results import RunResults
from .stages import stages

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@stages()
def plot_campbell(campbell: xr.Dataset, title: str | None = None) -> Figure:
    """Figure of the Campbell diagram and the dynamic clearance of one blade.

    Args:
        campbell: The result of `r37.campbell`.
        title: Title in place of the names that the figure has by default.

    Returns:
        A figure of Matplotlib, to be shown, changed or saved.

    Raises:
        ConfigError: For another dataset.

    Examples:
        >>> figure = r37.plot_campbell(r37.campbell("Ref", fidelity="draft"))
        >>> figure.axes[0].get_title()
        'Campbell diagram, blade Ref'
    """
    _check("campbell", campbell, "frequency", "r37.campbell")
    return _drawn("r37core.figures.campbell_diagram.draw_campbell", campbell, title or _label(campbell, "blade"))


@stages()
def plot_response(response: xr.Dataset, campbell: xr.Dataset | None = None, title: str | None = None) -> Figure:
    """Figure of rms and stress over speed, and of which speeds are dangerous, unknown or sustained.

    Args:
        response: The result of `r37.sweep`, or a part of the dataset rms of a run.
        campbell: The result of `r37.campbell`, to mark the crossings of 1B.
        title: Title in place of the names that the figure has by default.

    Returns:
        A figure of Matplotlib, to be shown, changed or saved.

    Raises:
        ConfigError: For other datasets.

    Examples:
        >>> response = r37.sweep("Ref", "abradable", [1150, 1550], fidelity="draft")
        >>> figure = r37.plot_response(response)
        >>> figure.axes[0].get_ylabel()
        'rms, normal (mm)'
    """
    _check("response", response, "rms_normal", "r37.sweep")
    if campbell is not None:
        _check("campbell", campbell, "frequency", "r37.campbell")
    name = title or _label(response, "blade")
    scenes = judged(response).drop_vars("scene", errors="ignore").expand_dims(scene=[_label(response, "scene")])
    if "speed" not in scenes.dims:
        scenes = scenes.expand_dims("speed")
    stress = scenes if "max_von_mises_median" in scenes else None
    return _drawn("r37core.figures.response_curves.draw_response", name, campbell, scenes, stress)


@stages()
def plot_rotor(rotor: xr.Dataset, title: str | None = None) -> Figure:
    """Figure of a rotor: dangerous speeds, its blades over speed, the worst stress, growth and nodal diameters there.

    Args:
        rotor: `rotor(blade, scene)` of the results of a run.
        title: Title in place of the names that the figure has by default.

    Returns:
        A figure of Matplotlib, to be shown, changed or saved.

    Raises:
        ConfigError: For another dataset, and for that of several runs.

    Examples:
        >>> scene = r37.scene("abradable", name="three", rotor={"blades": 3}, results=["stress"])
        >>> results = r37.run("Ref", scene, [1550], fidelity="draft")
        >>> r37.plot_rotor(results.rotor("Ref", "three"), "mine").get_suptitle()
        'mine: a rotor of 3 blades'
    """
    _check("rotor", rotor, "blade_rms", "rotor(blade, scene) of r37.run")
    if "run" in rotor.dims:
        raise ConfigError("rotor: found several runs; allowed: one, as results.rotor(blade, scene) of r37.open_results has it")
    several = rotor if "speed" in rotor.dims else rotor.expand_dims("speed")
    return _drawn(
        "r37studies.rotors.figures.draw_rotor", several, title or f"{_label(rotor, 'blade')}, {_label(rotor, 'scene')}"
    )


@stages()
def plot_run_ups(run_ups: xr.Dataset, title: str | None = None) -> Figure:
    """Figure of motion, stress and wear in every revolution of run-ups of one blade in one scene.

    Args:
        run_ups: The dataset run_ups of a run, or a part of its runs.
        title: Title in place of the names that the figure has by default.

    Returns:
        A figure of Matplotlib, to be shown, changed or saved.

    Raises:
        ConfigError: For another dataset, and for runs of several blades or scenes.

    Examples:
        >>> up = {"from_rad_s": 1540, "to_rad_s": 1560, "revolutions": 4}
        >>> results = r37.run("Ref", "abradable", run_ups={"up": up}, fidelity="draft", targets="results/run_ups.nc")
        >>> r37.plot_run_ups(results["run_ups"]).get_suptitle()
        'run-ups: Ref, abradable, leading edge'
    """
    _check("run_ups", run_ups, "rate", 'r37.run(..., run_ups=...)["run_ups"]')
    if "run" not in run_ups.dims:
        raise ConfigError("run_ups: found a run without its dimension; allowed: several, or one of them by isel(run=[0])")
    pairs = sorted(set(zip(*(map(str, run_ups[name].values) for name in ("blade", "scene")), strict=True)))
    if len(pairs) > 1:
        raise ConfigError(f"run_ups: found runs of {', '.join(map(' in '.join, pairs))}; allowed: of one blade in one scene")
    ((blade, scene),) = pairs
    return _drawn("r37studies.run_ups.figures.draw_run_ups", run_ups, title or f"{blade}, {scene}", blade=blade, scene=scene)


@stages()
def plot_tolerances(results: RunResults, blade: str, scene: str, title: str | None = None) -> Figure:
    """Figure of the band of the members, which of them are dangerous or unknown, and the effect of each number.

    Args:
        results: The results of a run with tolerances.
        blade, scene: Names of the blade and the scene.
        title: Title in place of the names that the figure has by default.

    Returns:
        A figure of Matplotlib, to be shown, changed or saved.

    Raises:
        ConfigError: For results without tolerances, and for a blade and scene that have none.

    Examples:
        >>> spread = {"of_scenes": {"casing.clearance_m": {"uniform_percent": 2}}, "members": 2}
        >>> results = r37.run("Ref", "abradable", [1150], tolerances=spread, fidelity="draft")
        >>> len(r37.plot_tolerances(results, "Ref", "abradable").axes) > 2
        True
    """
    if not isinstance(results, RunResults) or "tolerances" not in results:
        raise ConfigError("results: found none of tolerances; allowed: those of r37.run(..., tolerances=...)")
    tolerances = results["tolerances"]
    if blade not in tolerances["blade"].values or scene not in tolerances["scene"].values:
        known = f"{', '.join(map(str, tolerances['blade'].values))} in {', '.join(map(str, tolerances['scene'].values))}"
        raise ConfigError(f"tolerances: found none of {blade} in {scene}; allowed: {known}")
    spread, response = tolerances.sel(blade=blade, scene=scene), judged(results.response(blade, scene))
    return _drawn("r37studies.tolerances.figures.draw_tolerances", spread, response, title or f"{blade}, {scene}")


@stages()
def plot_designs(results: RunResults, title: str | None = None, *, family: str | None = None) -> Figure:
    """Figure of a family of designs: robustness over the varied key, a map over two, else by the designs' names.

    Args:
        results: The results of a run with families.
        title: Title in place of the names that the figure has by default.
        family: Family in place of the first one, as the column `family` of `tables["designs"]` has it.

    Returns:
        A figure of Matplotlib, to be shown, changed or saved.

    Raises:
        ConfigError: For results without designs, and for a family that they do not have.

    Examples:
        >>> family = r37.blade("S100", name="Sweep", vary={"sweep_percent": [50, 100]})
        >>> results = r37.run(family, "abradable", [1150], fidelity="draft")
        >>> r37.plot_designs(results).get_suptitle()
        'family Sweep: 2 designs over sweep_percent'
    """
    if not isinstance(results, RunResults) or "designs" not in results.tables:
        raise ConfigError("results: found none of designs; allowed: those of a run with a family, r37.blade(..., vary=...)")
    table = results.tables["designs"]
    families = compared_in(table)
    name = next(iter(families)) if family is None else family
    if name not in families:
        raise ConfigError(f"family: found {name!r}; allowed: {', '.join(families)}")
    draw = "maps.draw_design_map" if len(families[name].keys) == 2 else "figures.draw_designs"
    return _drawn(f"r37studies.designs.{draw}", title or name, table, to_plain(families[name]))


def _drawn(drawing: str, *arguments: Any, **more: Any) -> Figure:
    """The figure of a drawing function, by its name as rules have it, in the workflow's style."""
    import matplotlib
    import matplotlib.pyplot as plt

    # chosen now, as pyplot would when it draws: the style takes one without a display where none has been
    matplotlib.get_backend()
    with plt.rc_context():
        from r37core.figures.style import take_style

        take_style()
        return function_named(drawing)(*arguments, **more)


def _check(argument: str, dataset: xr.Dataset, needed: str, call: str) -> None:
    """ConfigError for a dataset that is not what a call gives."""
    if not isinstance(dataset, xr.Dataset) or needed not in dataset:
        other = f"a dataset without {needed}" if isinstance(dataset, xr.Dataset) else f"a {type(dataset).__name__}"
        raise ConfigError(f"{argument}: found {other}; allowed: what {call} gives")


def _label(dataset: xr.Dataset, name: str) -> str:
    """Which blade or scene a dataset is of: a part of a joined one says so in a coordinate, others in an attribute."""
    return str(dataset[name].item() if name in dataset.coords else dataset.attrs.get(name, ""))
