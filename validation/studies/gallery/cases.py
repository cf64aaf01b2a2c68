"""The gallery: a few runs beside the sweep, and docs/gallery.md of all. `snakemake gallery`"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from r37core.cases.case import Case
from r37core.config import ConfigError, Settings
from r37core.exports.plan import EXPORTED_MODES
from r37core.plans import paths
from validation.published import BLADES, INTERACTIONS, REFERENCE
from validation.studies.modelling_choices.cases import PUBLISHED_SPEEDS, scene_name
from validation.studies.plan import SweptPeak, case_of_sweep

FINE, COARSE = 248, 62
"""Instants of a revolution at which the paper recovers stress: for a picture of it, and for its largest value."""

REVOLUTION = "revolution"
"""Case with the stress at every instant of one revolution."""

WINDOW = (0.99, 1.06)
"""About an interaction, in shares of the published Campbell speed."""


@dataclass(frozen=True)
class Item:
    """One figure of the gallery: its `name` in captions and file names, its title, and the checks that belong to it."""

    name: str
    title: str
    checks: tuple[str, ...]


ITEMS = (
    Item("campbell", "Campbell diagram", (r"^Ref 1B/\d: Campbell$",)),
    Item("modes", "First three mode shapes", (r"^Ref: 1B at rest",)),
    Item("mesh", "Mesh and submesh of stress", (r"^mesh", r"^area of the profile", r"^volume")),
    Item(
        "reference",
        "Response of the reference blade",
        (r"^Ref 1B/\d: (peak|drop)", r"^direct: ", r"^Ref (lined|direct), 750", r"^Ref lined: response of the torsion"),
    ),
    Item("spectrum_lined", "Spectral map with lining", (r"^Ref 1B/\d: engine order",)),
    Item("spectrum_direct", "Spectral map in direct contact", (r"^direct, engine order",)),
    Item("revolution", "Stress within a revolution, at 248 and 62 instants", (r"^largest stress of the last revolution",)),
    Item(
        "histories",
        "Stress of every revolution",
        (r"^Ref lined at .*first yield", r"^direct at .*first yield", r"below yield", r"^at \d+: ", r"first contact$"),
    ),
    Item("stress", "Stress over speed", (r"^Ref 1B/4: width above yield", r"^direct: largest rms")),
    Item("wear_content", "Wear and its spatial content", (r"^Ref 1B/\d: lobes", r"^Ref lined: (worn through|deepest wear)")),
    Item("variants", "Shapes of the variants", (r"^(?!Ref)\w+ 1B/4: Campbell$",)),
    Item("variants_spectra", "Spectral maps of the variants, with lining", (r"^(?!Ref)\w+ 1B/4: (engine order|lobes)",)),
    Item(
        "variants_response",
        "Response of the variants",
        (r"^(?!Ref)\w+ 1B/4: (peak|drop)", r"at its peak: ", r"^CS100 has more", r"^stress at the peak"),
    ),
    Item("clearances", "Dynamic clearances", (r"dynamic clearance",)),
    Item(
        "peak_histories",
        "Stress of every revolution at the peaks",
        (r"earliest first yield", r"latest first yield", r"first yield at our"),
    ),
    Item("widths", "Widths above yield", (r"width above yield", r"^CS100 has a wider")),
)


RUNS_OF_SWEEP = (*((blade, "lined") for blade in BLADES), (REFERENCE, "direct"))
"""Blade and kind of scene of every run of the sweep that is shown."""


def scenes_of(settings: Settings) -> dict[str, str]:
    """Names of the scene with lining and of the one without; ConfigError where blades, scenes or their results are missing."""
    scenes = {kind: scene_name(settings, kind) for kind in ("lined", "direct")}
    lacking = [blade for blade in BLADES if blade not in settings.blades]
    lacking += [scene for scene in scenes.values() if scene not in settings.scenes]
    if lacking:
        raise ConfigError(
            f"config.yaml: blades, scenes: the gallery needs {', '.join(lacking)}, which this run leaves out; "
            f"allowed: at least {', '.join(BLADES)} in {' and '.join(scenes.values())}"
        )
    for kind, scene in scenes.items():
        wanted = {"spectrum", "stress", *(["wear"] if kind == "lined" else [])}
        if missing := wanted - set(settings.scenes[scene].results):
            raise ConfigError(f"scenes.yaml: {scene}.results: the gallery needs {', '.join(sorted(missing))}, too")
    return scenes


def cases(settings: Settings) -> dict[str, Case]:
    """Stress of every revolution at the published speeds and at each blade's own peak, and one revolution in detail."""
    scenes, main = scenes_of(settings), INTERACTIONS[0]
    campbell = {row.blade: row.campbell for row in INTERACTIONS if row.engine_order == main.engine_order}
    cases_of_runs = {}
    for blade, kind in RUNS_OF_SWEEP:
        scene = scenes[kind]
        fields: dict[str, Any] = {"speeds": PUBLISHED_SPEEDS if blade == REFERENCE else (), "results": ("stress",)}
        if kind == "lined":
            fields["swept_peak"] = SweptPeak(scene, WINDOW[0] * campbell[blade], WINDOW[1] * campbell[blade])
        case = case_of_sweep(settings, blade, scene, history_speeds=None, **fields)
        cases_of_runs[f"{blade}__{kind}"] = _with_instants(case, COARSE)
    detail = case_of_sweep(settings, REFERENCE, scenes["lined"], speeds=(main.peak,), results=("stress", "instants"))
    return cases_of_runs | {REVOLUTION: _with_instants(detail, FINE)}


def _with_instants(case: Case, number: int) -> Case:
    return replace(case, choice=replace(case.choice, snapshots_per_revolution=number))


def inputs(settings: Settings) -> dict[str, Any]:
    """Responses of the sweep, and what pictures are made of; ConfigError without the benchmark's blades and scenes."""
    scenes = scenes_of(settings)
    return {
        "responses": [paths.fill(paths.RESPONSE, blade=blade, scene=scenes[kind]) for blade, kind in RUNS_OF_SWEEP],
        "campbells": [paths.fill(paths.CAMPBELL, blade=blade) for blade in BLADES],
        "geometry": paths.fill(paths.GEOMETRY, blade=REFERENCE),
        "meshes": [paths.fill(paths.MESH, blade=blade) for blade in BLADES],
        "modes": paths.fill(EXPORTED_MODES, blade=REFERENCE),
    }


def outputs(settings: Settings) -> dict[str, str]:
    """The page and its pictures."""
    return {"page": "docs/gallery.md"} | {item.name: f"docs/gallery/{item.name}.png" for item in ITEMS}


def values(settings: Settings) -> dict[str, Any]:
    """Names of the scenes, where stress is recovered on the reference blade, and the level."""
    return {
        "scenes": scenes_of(settings),
        "submesh": settings.reduction_choice(REFERENCE).stress_submesh,
        "fidelity": settings.fidelity_name,
    }
