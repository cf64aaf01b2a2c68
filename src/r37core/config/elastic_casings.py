"""Elastic casings of a run: the waves that its rotor overtakes are simulated, and are remarked on."""

from collections.abc import Iterator

from r37core.contact.elastic_casing import ENOUGH, ElasticCasing, flexibility, flexibility_of, nodal_diameters_for
from r37core.contact.ring import MOST_NODAL_DIAMETERS

from .settings import Settings, fastest_of


def elastic_casings(settings: Settings) -> dict[str, ElasticCasing]:
    """Elastic casing of each scene to run that has one."""
    entries = {name: settings.scene_designs.entries[name].casing for name in settings.scene_names}
    return {name: casing.elastic_casing() for name, casing in entries.items() if casing.elastic}


def elastic_casings_have_their_waves(settings: Settings) -> None:
    """Rings have the waves that the rotor overtakes at the highest speed of their scene, and most of their flexibility."""
    for scene in elastic_casings(settings):
        waves_are_simulated(settings, scene, fastest_of(settings, scene))


def waves_are_simulated(settings: Settings, scene: str, fastest: float) -> None:
    """ConfigError for a ring that lacks waves that a rotor of `fastest` (rad/s) overtakes, or much of its flexibility."""
    ring = settings.scene_designs.entries[scene].casing.elastic_casing().ring
    if ring is None or ring.highest_nodal_diameter >= (needed := nodal_diameters_for(ring, fastest)):
        return
    share = flexibility_of(ring.modes()) / flexibility(ring)
    shown = f"{ring.highest_nodal_diameter} nodal diameters, {share:.1%} of the ring's static flexibility"
    rule = f"for {ENOUGH:.0%} and all waves that the rotor overtakes up to {fastest:g} rad/s"
    allowed = f"{needed} or more, or leave it out, {rule}"
    if needed > MOST_NODAL_DIAMETERS:
        allowed = (
            f"at most {MOST_NODAL_DIAMETERS}, and {needed} are needed {rule}: a thicker ring, or the ring_modes that count"
        )
    raise settings.scene_designs.document.refusal(shown, allowed, scene, "casing", "ring", "highest_nodal_diameter")


def remarks_on_overtaken_waves(scene: str, casing: ElasticCasing, fastest: float) -> Iterator[str]:
    """Remark on a scene with speeds up to `fastest` (rad/s); none below the casing's lowest critical speed."""
    if fastest > casing.critical_speed:
        yield (
            f"scene {scene}: speeds up to {fastest:g} rad/s; above {casing.critical_speed:.4g} the rotor overtakes waves of "
            "the casing, which may then grow without bound"
        )
