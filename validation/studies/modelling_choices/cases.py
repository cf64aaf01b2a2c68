"""The study `modelling_choices`: what the benchmark leaves open, as shipped and with each choice varied once.

`snakemake modelling_choices`
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from math import ceil, floor
from typing import Any

from r37core.cases.case import Case, ModelChoice, changed
from r37core.config import Settings, checked_scene, plain
from r37core.contact.scene import Scene
from r37core.plans import paths
from validation.published import BLADES, DIRECT_PEAK, INTERACTIONS, QUIET, REFERENCE
from validation.studies.plan import (
    campbell_file,
    integration_of_level,
    kept_of,
    level_of,
    material_of,
    model_of_level,
    scene_entry_of,
)
from validation.studies.sections import SpeedSteps


@dataclass(frozen=True)
class ModellingChoice:
    """One way to understand what the paper leaves open.

    `changes`: dotted path in a scene's entry of scenes.yaml -> value; `model`: fields of ModelChoice. `quick`: the time
    integration of the study's quick level in place of the base level's; `steps`: its time step times this; `fine`: wide
    windows on the fine grid of speeds, else narrow ones on the coarse grid; `surveys`: the whole range of speeds; `blades`:
    whose interactions, None: all.
    """

    what: str
    changes: Mapping[str, Any] = field(default_factory=dict)
    model: Mapping[str, Any] = field(default_factory=dict)
    quick: bool = False
    steps: float = 1.0
    fine: bool = False
    surveys: bool = False
    blades: tuple[str, ...] | None = None

    @property
    def only_lining(self) -> bool:
        """Whether it says nothing about direct contact."""
        return bool(self.changes) and all(path.startswith("lining.") for path in self.changes)


SHIPPED = "shipped"
SURVEY = "survey"
BASELINE = "baseline"

CONVERGENCE = {
    "double_step": ModellingChoice("twice the published step", steps=2.0),
    "half_step": ModellingChoice("half the published step", steps=0.5, blades=("Ref",)),
    "mesh_10000": ModellingChoice("mesh of 10,000 nodes", model={"nodes": 10000}),
    "mesh_40000": ModellingChoice("mesh of 40,000 nodes", model={"nodes": 40000}, blades=("Ref",)),
    "quick": ModellingChoice("time integration of the quick level", quick=True),
    "perturbed": ModellingChoice("friction 0.1% larger", {"friction.coefficient": lambda value: 1.001 * value}),
}
"""As shipped with one numerical choice changed; `perturbed` shows what the motion's sensitivity alone does.

The clearance would be no perturbation: without yield stress the lined scene scales with it until the lining is worn through."""


def _varied(what: str, changes: Mapping[str, Any] | None = None, **model: Any) -> ModellingChoice:
    return ModellingChoice(what, changes or {}, {"nodes": 10000} | model, quick=True)


VARIED = {
    BASELINE: _varied("as shipped"),
    "radial": _varied("radial normal: a cylindrical casing", {"casing.cone_angle_deg": 0}),
    "constant": _varied("constant friction: the vibration's part of the sliding neglected", {"friction.form": "constant"}),
    **{
        f"width_{width:g}": _varied(f"bars {width:g} mm wide", {"lining.bar_width_m": 1e-3 * width})
        for width in (0.5, 0.8, 1.25, 2.0)
    },
    "camber": _varied("nodes on the camber line", tip_line="camber"),
    "suction": _varied("nodes on the suction edge", tip_line="suction_edge"),
    "inside": _varied("corners not among the nodes", corners=False),
    "exact": _varied("exact gap", {"gap": "exact"}),
    "yield_mpa": _varied("yield stress of the lining in MPa", {"lining.yield_stress_pa": 1.5e6}),
}
"""Each choice varied once, cheaply: time integration of the quick level, 10,000 nodes. Compare with the first."""

CHOICES = {
    SHIPPED: ModellingChoice("as shipped", fine=True),
    SURVEY: ModellingChoice("as shipped, the whole range", quick=True, surveys=True),
    **CONVERGENCE,
    **VARIED,
}

FINE_WINDOW = (0.0, 0.05)
"""About an interaction, in shares of the published Campbell speed."""

COARSE_WINDOW = (-0.012, 0.016)
"""About an interaction, in shares of the published peak speed."""

DIRECT_WINDOW = (-20.0, 28.0)
"""About direct contact's published largest rms (rad/s)."""

ELSEWHERE = (850.0, 1000.0, 1100.0, 1200.0, 1300.0, 1400.0, 1500.0, 1600.0, 1717.0, 1800.0, 1900.0)
"""Speeds (rad/s) of direct contact beside its window."""

WHOLE_RANGE = (750.0, 2000.0)
DIRECT = "Ref_direct"
HISTORIES = "Ref_histories"
"""Cases of direct contact, and of speeds of the lined scene whose stress is kept for every revolution."""

LEVEL = "level"
"""Name of the base level's own mesh among those of Campbell diagrams."""

MESHES = (10000, 40000)
"""Nodes of the meshes whose Campbell diagrams are compared."""

PUBLISHED_SPEEDS = tuple(sorted((INTERACTIONS[0].peak, DIRECT_PEAK, QUIET)))
"""Speeds (rad/s) whose stress the paper shows for every revolution."""

_HIGHEST_ORDER = 12
"""Of the spectra."""


@dataclass(frozen=True)
class Window:
    """A blade in one kind of scene (lined or direct) at some speeds (rad/s, ascending); see Case for the others."""

    blade: str
    kind: str
    speeds: tuple[float, ...]
    history_speeds: tuple[float, ...] = ()
    follow: bool = False
    spectrum: bool = False


def windows(choice: ModellingChoice, steps: SpeedSteps) -> dict[str, Window]:
    """What a choice runs, by name; `steps` (rad/s): of the grids `fine`, `coarse` and `survey`."""
    if choice.surveys:
        return _surveys(steps.survey)
    step = steps.fine if choice.fine else steps.coarse
    planned = {}
    for row in INTERACTIONS:
        if choice.blades is None or row.blade in choice.blades:
            centre, (below, above) = (row.campbell, FINE_WINDOW) if choice.fine else (row.peak, COARSE_WINDOW)
            speeds = grid(centre, below * centre, above * centre, step)
            planned[row.name] = Window(row.blade, "lined", speeds, follow=choice.fine)
    if INTERACTIONS[0].name in planned:
        planned[HISTORIES] = Window(REFERENCE, "lined", PUBLISHED_SPEEDS, PUBLISHED_SPEEDS)
    if not choice.only_lining:
        others = {*ELSEWHERE, DIRECT_PEAK + 1.0} if choice.fine else {*ELSEWHERE}
        speeds = tuple(sorted(others.union(grid(DIRECT_PEAK, *DIRECT_WINDOW, step))))
        planned[DIRECT] = Window(REFERENCE, "direct", speeds, PUBLISHED_SPEEDS)
    return planned


def _surveys(step: float) -> dict[str, Window]:
    low, high = WHOLE_RANGE
    every, every_other = grid(low, 0.0, high - low, step), grid(low, 0.0, high - low, 2.0 * step)
    return {
        "Ref_lined": Window(REFERENCE, "lined", every, spectrum=True),
        "Ref_direct": Window(REFERENCE, "direct", every_other, spectrum=True),
        "CS100_lined": Window("CS100", "lined", every, spectrum=True),
    }


def grid(centre: float, below: float, above: float, step: float) -> tuple[float, ...]:
    """Multiples of `step` about `centre`, from `below` to `above` it."""
    first, last = ceil(below / step - 1e-9), floor(above / step + 1e-9)
    return tuple(centre + number * step for number in range(first, last + 1))


def cases(settings: Settings) -> dict[str, Case]:
    """A case for each choice, blade and window of speeds, as `choice/window`."""
    steps = settings.studies.modelling_choices.speed_steps_rad_s
    planned = {}
    for name, choice in CHOICES.items():
        for window_name, window in windows(choice, steps).items():
            entry = plain(scene_entry_of(settings, scene_name(settings, window.kind)))
            planned[f"{name}/{window_name}"] = case_in(settings, choice, window, checked_scene(changed(entry, choice.changes)))
    return planned


def scene_name(settings: Settings, kind: str) -> str:
    """Name of the `lined` or the `direct` scene."""
    return getattr(settings.studies.modelling_choices, f"{kind}_scene")


def case_in(settings: Settings, choice: ModellingChoice, window: Window, scene: Scene) -> Case:
    """What a choice runs in a window, in a scene with the choice's changes."""
    section = settings.studies.modelling_choices
    integration = integration_of_level(settings, section.quick if choice.quick else section.base, scene)
    return Case(
        window.blade,
        _model(settings, window.blade, choice.model),
        scene,
        replace(integration, time_step=choice.steps * integration.time_step),
        window.speeds,
        ("stress", *(["wear"] if scene.lining else []), *(["spectrum"] if window.spectrum else [])),
        material_of(settings, window.blade),
        kept=kept_of(level_of(settings, section.base)) | {"spectrum_highest_order": _HIGHEST_ORDER},
        history_speeds=window.history_speeds,
        follow=window.follow,
        what=choice.what,
    )


def _model(settings: Settings, blade: str, changes: Mapping[str, Any]) -> ModelChoice | str:
    """This run's own model where that is the same."""
    material_of(settings, blade)
    base, mine = level_of(settings, settings.studies.modelling_choices.base), settings.fidelity
    if not changes and (base.mesh, base.reduction) == (mine.mesh, mine.reduction):
        return settings.structure.boundary.tip_line
    return replace(model_of_level(settings, settings.studies.modelling_choices.base), **changes)


def campbell_files(settings: Settings) -> dict[tuple[str, str], str]:
    """Campbell diagrams by blade and mesh: LEVEL, or so many nodes."""
    files = {(blade, LEVEL): campbell_file(blade, _model(settings, blade, {})) for blade in BLADES}
    finer = {str(nodes): _model(settings, REFERENCE, {"nodes": nodes}) for nodes in MESHES}
    return files | {(REFERENCE, nodes): campbell_file(REFERENCE, model) for nodes, model in finer.items()}


def inputs(settings: Settings) -> dict[str, Any]:
    """Shape of the reference blade, and Campbell diagrams."""
    return {"geometry": paths.fill(paths.GEOMETRY, blade=REFERENCE), "campbells": list(campbell_files(settings).values())}


def outputs(settings: Settings) -> dict[str, str]:
    """Tables and pictures."""
    files = {"validation": "validation.md", "table": "modelling_choices.md", "picture": "figures/modelling_choices.png"}
    pictures = ("reference", "blades", "stress", "histories", "spectrum_lined", "spectrum_direct")
    files |= {name: f"figures/validation_{name}.png" for name in pictures}
    return {name: f"<results>/studies/{file}" for name, file in files.items()}


def values(settings: Settings) -> dict[str, Any]:
    """Which Campbell diagrams there are."""
    return {"campbells": list(campbell_files(settings))}
