"""What a run says of elastic casings before it starts: of waves that the rotor overtakes, and of modes that are left out."""

from __future__ import annotations

from collections.abc import Mapping

from r37core.contact.elastic_casing import ElasticCasing, flexibility, flexibility_of, nodal_diameters_for
from r37core.contact.ring import MOST_NODAL_DIAMETERS, Ring

from .settings import Settings
from .speed_choice import fastest_of

ENOUGH = 0.95
"""Share of the give under a force from which on nothing is said, and for which nodal diameters are named."""

_KEY = "casing.ring.highest_nodal_diameter"


def elastic_casings(settings: Settings) -> dict[str, ElasticCasing]:
    """Of each scene to run whose casing gives way."""
    entries = {name: settings.scene_entries[name].casing for name in settings.scene_names}
    return {name: casing.elastic_casing() for name, casing in entries.items() if casing.elastic}


def of_sweep(settings: Settings) -> list[str]:
    """Of casings whose waves a blade of the sweep overtakes."""
    lines = (of_speeds(name, casing, fastest_of(settings, name)) for name, casing in elastic_casings(settings).items())
    return [line for line in lines if line]


def of_speeds(scene: str, casing: ElasticCasing, fastest: float) -> str:
    """Of a scene with speeds up to `fastest` (rad/s) above the casing's lowest critical speed; nothing below it."""
    if fastest <= casing.critical_speed:
        return ""
    remark = (
        f"scene {scene}: speeds up to {fastest:g} rad/s; above {casing.critical_speed:.4g} the rotor overtakes waves of the "
        "casing, which may then grow without bound"
    )
    unseen = [mode.nodal_diameter for mode in casing.overtaken(fastest) if mode not in casing.modes]
    if casing.ring is None or not unseen:
        return remark
    highest = casing.ring.highest_nodal_diameter
    return f"{remark}; the simulation does not show those of {unseen[0]} to {unseen[-1]} nodal diameters: {_KEY} is {highest}"


def of_left_out_modes(casings: Mapping[str, ElasticCasing]) -> list[str]:
    """Of rings that give way less under a force than they would with all modes, those that scenes share once."""
    scenes: dict[Ring, list[str]] = {}
    for name, casing in casings.items():
        if casing.ring is not None:
            scenes.setdefault(casing.ring, []).append(name)
    lines = []
    for ring, names in scenes.items():
        part, whole = flexibility_of(ring.modes()), flexibility(ring)
        if part / whole < ENOUGH:
            needed = nodal_diameters_for(ring, ENOUGH, MOST_NODAL_DIAMETERS) or f"not even {MOST_NODAL_DIAMETERS}"
            lines.append(
                f"scene {', '.join(names)}: the modes up to {_KEY} {ring.highest_nodal_diameter} give way {1e6 * part:.3g} "
                f"um/N at a force that rests, {part / whole:.0%} of what the whole ring does, {1e6 * whole:.3g}; {needed} have "
                f"{ENOUGH:.0%}"
            )
    return lines
