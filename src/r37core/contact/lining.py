"""The law of one bar of the abradable lining. Plain numbers here; the time integration compiles it as it stands."""

from __future__ import annotations

from typing import Any


def return_mapping(penetration: float, wear: float, lining: Any) -> tuple[float, float]:
    """Stress (Pa) and new wear (m) of a bar whose surface is pressed to `penetration` (m) beyond its first position.

    `lining`: whatever has the fields of r37core.contact.scene.Lining. Trial stress E (penetration - wear)/thickness against
    the yield stress plus plastic modulus times plastic strain; beyond it, plastic strain grows by the excess over E plus the
    plastic modulus (Simo and Hughes, Computational Inelasticity, box 1.4). A bar cannot pull, and wear never shrinks nor
    passes the thickness.
    """
    thickness = lining.thickness
    stiffness = lining.elastic_modulus / thickness
    trial = stiffness * (penetration - wear)
    if not trial > 0.0:
        return 0.0, wear
    excess = trial - (lining.yield_stress + lining.plastic_modulus * wear / thickness)
    if not excess > 0.0:
        return trial, wear
    worn = min(wear + thickness * excess / (lining.elastic_modulus + lining.plastic_modulus), thickness)
    return max(stiffness * (penetration - worn), 0.0), worn
