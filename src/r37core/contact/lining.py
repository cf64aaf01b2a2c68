"""The law of one bar of the abradable lining."""

from __future__ import annotations

from numba import njit


@njit(cache=True, forceinline=True)
def return_mapping(penetration, wear, thickness, elastic_modulus, plastic_modulus, yield_stress):
    """Press a bar's surface to `penetration` (m) beyond its first position. Returns (stress in Pa, new wear in m).

    Trial stress E (penetration - wear)/thickness against the yield stress plus plastic modulus times plastic strain;
    beyond it, plastic strain grows by the excess over E plus the plastic modulus (Simo and Hughes, Computational
    Inelasticity, box 1.4). A bar cannot pull, and wear never shrinks nor passes the thickness.
    """
    trial = elastic_modulus * (penetration - wear) / thickness
    if trial <= 0.0:
        return 0.0, wear
    excess = trial - (yield_stress + plastic_modulus * wear / thickness)
    if excess > 0.0:
        wear = min(wear + thickness * excess / (elastic_modulus + plastic_modulus), thickness)
        trial = max(elastic_modulus * (penetration - wear) / thickness, 0.0)
    return trial, wear
