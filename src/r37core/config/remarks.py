"""Remarks of the pipeline before a run starts, and at its end."""

from collections.abc import Collection, Iterator, Sequence

from r37core.rom.reduction_choice import LINEAR, POINTS, QUADRATIC

from .elastic_casings import elastic_casings, remarks_on_overtaken_waves
from .settings import Settings, contact_of_blades, direct_on_points, fastest_of
from .spread import Spreads

LARGE_FRICTION = 0.2
"""Coefficient up to which the two integrators agree within 2% on average, in direct contact on patches, at settled speeds."""


def remarks_of_pipeline(settings: Settings) -> Iterator[str]:
    """Remarks of the pipeline before a run starts."""
    yield from remarks_on_input(settings)
    yield from remarks_on_unlike_contact(settings)


def remarks_on_input(settings: Settings, changed: Collection[str] = ()) -> Iterator[str]:
    """Remarks on speeds, materials, contact laws and casings before any run, of the workflow or of a call.

    `changed`: scenes whose clearance a call has changed.
    """
    yield from remarks_on_speeds(settings)
    yield from remarks_on_blades(settings)
    yield from remarks_on_laws(settings)
    yield from remarks_on_lobes(settings, changed)
    yield from remarks_on_linear_variants(settings)
    for scene, casing in elastic_casings(settings).items():
        yield from remarks_on_overtaken_waves(scene, casing, fastest_of(settings, scene))


def remarks_on_speeds(settings: Settings) -> Iterator[str]:
    """Remark on speeds beyond what models are made for."""
    fastest = max(plan.every_speed()[-1] for plan in settings.speed_plans.values())
    highest = settings.structure.maximum_speed_rad_s
    if fastest > highest:
        yield (
            f"speeds: up to {fastest:g} rad/s, and structure.maximum_speed_rad_s is {highest:g}: reduced models and "
            "Campbell diagrams are made for speeds up to that; raise it to what is run"
        )


def remarks_on_blades(settings: Settings) -> list[str]:
    """Remarks on unusual materials, and of what the blades are given by."""
    blades: dict[str, list[str]] = {}
    for name, blade in settings.blades.items():
        for key, (value, (low, high)) in ({} if blade.material is None else blade.material.unusual).items():
            text = f"material.{key}: found {value:g}; alloys and composites have {low:g} to {high:g}: check its unit"
            blades.setdefault(text, []).append(name)
        for text in blade.definition.remarks(settings.root, blade.material):
            blades.setdefault(text, []).append(name)
    return [f"{_first_few(names)}: {text}" for text, names in blades.items()]


def _first_few(names: Sequence[str]) -> str:
    """The first three of some names."""
    return f"{', '.join(names[:3])}{', ...' if len(names) > 3 else ''}"


def remarks_on_laws(settings: Settings) -> Iterator[str]:
    """Remarks on friction under which no integrator is sure, and on a lining that resists with next to nothing."""
    patched = [blade for blade in settings.blade_names if settings.contact_of(blade) != POINTS]
    for name, chosen in settings.scenes.items():
        friction, lining = chosen.scene.friction, chosen.scene.lining
        if friction is not None and not chosen.scene.lined and friction.coefficient > LARGE_FRICTION:
            yield (
                f"scene '{name}': friction.coefficient is {friction.coefficient:g}; above {LARGE_FRICTION:g} exact_modal and "
                "central_difference differ in direct contact, at any step, by a fifth and more on some blades; compare "
                "fidelity standard with paper (docs/accuracy.md#what-chaos-decides)"
            )
        if lining and lining.plastic_modulus == 0.0:
            yield (
                f"scene '{name}': lining.plastic_modulus_pa is 0: bars do not harden, and resist with no more than "
                f"lining.yield_stress_pa, {lining.yield_stress:g} Pa, until they are worn through; where that is little, the "
                "blade does not move, and numbers of 0 are no result"
            )
        if lining and lining.published and patched:
            yield (
                f"scene '{name}': lining.bar_width_m and bar_area_m2 are the published model's: the lining of "
                f"{_first_few(patched)} depends on structure.boundary.nodes and covers a part of the tip; left out, it covers "
                "all of it, as in the scene material_abradable"
            )


def remarks_on_lobes(settings: Settings, changed: Collection[str] = ()) -> Iterator[str]:
    """Remark on lobes given in clearances in scenes whose clearance is spread, `changed` by a call, or differs in this run."""
    casings = {name: settings.scene_designs.entries[name].casing for name in settings.scene_names}
    scaled = {name: casing for name, casing in casings.items() if casing.lobes and casing.amplitude_clearances}
    spread, differ = _spread_numbers(settings), len({casing.cold_clearance for casing in scaled.values()}) > 1
    keys = {name: "clearance_m" if casing.clearance is None else "clearance.cold_m" for name, casing in scaled.items()}
    names = [name for name, key in keys.items() if differ or name in changed or f"casing.{key}" in spread]
    if names:
        yield (
            f"scene {', '.join(names)}: lobes grow with the clearance, which this run changes or spreads: "
            "casing.amplitude_clearances gives their height in clearances; casing.amplitude_m holds it "
            "(docs/clearance_and_lining.md)"
        )


def _spread_numbers(settings: Settings) -> set[str]:
    """Dotted keys of scene numbers that spread."""
    return {key for _, section in settings.config if isinstance(section, Spreads) for key in section.of_scenes}


def remarks_on_linear_variants(settings: Settings) -> Iterator[str]:
    """Remark on blades that are linear because their base is, where nothing of their own says so."""
    entries = settings.designs.entries
    variants = [
        name
        for name in settings.blades
        if settings.kinematics_of(name) == LINEAR and not settings.structure.kinematics and not entries[name].kinematics
    ]
    if variants:
        yield (
            f"{_first_few(variants)}: linear, as the base is; large motions and their stress come out too high; for numbers to "
            f"decide from: structure: {{ kinematics: {QUADRATIC} }} (docs/large_motion.md)"
        )


def remarks_at_end(settings: Settings) -> Iterator[str]:
    """Remarks at the end of a run on its contact and on rigid casings without a lining."""
    casings = {name: settings.scene_designs.entries[name] for name in settings.scene_names}
    rigid = [name for name, entry in casings.items() if entry.lining is None and not entry.casing.elastic]
    yield from remarks_on_points(settings)
    if rigid:
        yield (
            f"{_first_few(rigid)}: the bare casing is rigid; an elastic one took the largest stress of S100 at 1867 rad/s from "
            "4.33 to 1.87 times yield (docs/accuracy.md#which-modes-the-stress-counts): casing.ring (docs/elastic_casing.md)"
        )


def remarks_on_points(settings: Settings) -> Iterator[str]:
    """Remark at the end of a run on direct contact on points, which has no limit in the mesh."""
    scenes, blades = direct_on_points(settings)
    if scenes:
        of = f"{len(blades)} blades" if len(blades) > 1 else blades[0]
        yield (
            f"{', '.join(scenes)}: contact of {of} acts on points, as published, and changes with every finer mesh; for "
            "numbers to decide from: structure.boundary.contact: patches (docs/accuracy.md#points-and-patches)"
        )


def remarks_on_unlike_contact(settings: Settings) -> Iterator[str]:
    """Remark on blades with stress whose contact differs, so that their lengths above yield cannot be compared."""
    kinds: dict[str, list[str]] = {}
    for name, contact in contact_of_blades(settings).items():
        if not settings.blades[name].is_matrices:
            kinds.setdefault(contact, []).append(name)
    if len(kinds) < 2:
        return
    different = "; ".join(f"{contact}: {_first_few(names)}" for contact, names in kinds.items())
    kinematics = "" if len({settings.kinematics_of(name) for name in settings.blades}) == 1 else f"kinematics: {QUADRATIC}, "
    yield (
        f"contact differs ({different}): blades are ranked among those of the same contact; "
        f"structure: {{ {kinematics}boundary: {{ contact: patches }} }} gives all blades one order"
    )
