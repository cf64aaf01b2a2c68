"""The laws of contact, each a formula with its source: gap, lining, friction. The time integration compiles them as they stand.

Written for numbers or arrays alike; only the law of the lining, which branches, takes plain numbers.
"""

from typing import Any

import numpy as np


def displaced_position(
    normal: Any, tangential: Any, meridional: Any, radius: Any, cosine: float, sine: float
) -> tuple[Any, Any]:
    """Position along the casing's normal (m) and gain in angle about the axis (rad) of a node displaced by three parts (m).

    The casing is a cone of half angle alpha (`cosine`, `sine`), the node at `radius` (m). Its distance from the axis becomes
    sqrt(R^2 + y^2), R = radius + u_r, u_r = cos(alpha) n + sin(alpha) m: what it exceeds R by counts with cos(alpha). Its angle
    grows by atan(y/R).
    """
    along_radius = radius + cosine * normal + sine * meridional
    axis_distance = np.sqrt(along_radius * along_radius + tangential * tangential)
    excess = tangential * tangential / (axis_distance + along_radius)
    return normal + cosine * excess, np.arctan2(tangential, along_radius)


def lobe_shape(theta: Any, period: float, width: float) -> Any:
    """f(theta) of the lobed casing for angles (rad): one lobe in each `period` (rad), `width` relative to it.

    f = exp(-[((theta mod p)/p - 1/2)/width]^2). Source: section 5 of the benchmark.
    """
    return np.exp(-((((theta % period) / period - 0.5) / width) ** 2))


def return_mapping(penetration: float, wear: float, elastic_modulus: float, lining: Any) -> tuple[float, float]:
    """Stress (Pa) and new wear (m) of a bar whose surface is pressed to `penetration` (m) beyond its first position.

    `elastic_modulus` (Pa) of the bar, or of it in series with what holds the node; `lining`: whatever has the other fields of
    r37core.contact.scene.Lining. Trial stress E (penetration - wear)/thickness against
    the yield stress plus plastic modulus times plastic strain; beyond it, plastic strain grows by the excess over E plus the
    plastic modulus (Simo and Hughes, Computational Inelasticity, box 1.4). A bar cannot pull, and wear never shrinks nor
    passes the thickness.
    """
    thickness = lining.thickness
    stiffness = elastic_modulus / thickness
    trial = stiffness * (penetration - wear)
    if not trial > 0.0:
        return 0.0, wear
    excess = trial - lining.yield_stress - lining.plastic_modulus * wear / thickness
    if not excess > 0.0:
        return trial, wear
    worn = min(wear + thickness * excess / (elastic_modulus + lining.plastic_modulus), thickness)
    return max(stiffness * (penetration - worn), 0.0), worn


def series_modulus(elastic_modulus: float, stiffness: float, flexibility: Any) -> Any:
    """Elastic modulus (Pa) of a bar of `stiffness` (N/m) with a `flexibility` (m/N) behind it: two springs in series."""
    return elastic_modulus / (1.0 + stiffness * flexibility)


def lines_of_bar(elastic_modulus: Any, area: Any, lining: Any) -> tuple[Any, Any, Any]:
    """The force of return_mapping as two lines: stiffness (N/m) of the elastic, offset (N) and stiffness of the plastic one.

    The bar pressed to x, worn by w before, has the force max(0, min(elastic (x - w), offset + plastic x)), until it is worn
    through: elastic E A/e, offset and plastic E/(E + K) A times the yield stress and K/e, with the area A and the thickness e.
    `elastic_modulus` E (Pa), of the bar or in series; `area` (m2) that is pressed; `lining`: as of return_mapping.
    """
    axial_stiffness, per_thickness = elastic_modulus * area, 1.0 / lining.thickness
    share = axial_stiffness / (elastic_modulus + lining.plastic_modulus)
    return axial_stiffness * per_thickness, share * lining.yield_stress, share * (lining.plastic_modulus * per_thickness)


def worn(penetration: Any, wear: Any, lining: Any) -> Any:
    """Wear (m) of a bar that was worn by `wear` (m) and is pressed to `penetration` (m), at most its thickness.

    What return_mapping says, without its force: (E x - e yield stress)/(E + plastic modulus), if that is more than before.
    """
    yielding = lining.elastic_modulus * penetration - lining.thickness * lining.yield_stress
    return np.maximum(wear, yielding * (1.0 / (lining.elastic_modulus + lining.plastic_modulus)))


def line_of_wear(lining: Any) -> tuple[float, float]:
    """The wear of `worn` over the penetration as a line: its slope, and its offset (m)."""
    share = 1.0 / (lining.elastic_modulus + lining.plastic_modulus)
    return lining.elastic_modulus * share, -lining.thickness * lining.yield_stress * share


def wear_at_the_casing(lining: Any) -> float:
    """Wear (m) of a bar that is pressed to the casing behind the lining, by all of its thickness: the largest there is.

    Less than the thickness e, for the elastic part springs back: e (E - yield stress)/(E + plastic modulus).
    """
    return float(worn(lining.thickness, 0.0, lining))


def used_thickness(wear: float, lining: Any) -> float:
    """Thickness (m) of a lining that a bar worn by `wear` (m) has used: how deep it was pressed, 0 for no wear.

    The inverse of worn: x = (wear (E + plastic modulus) + e yield stress)/E. At the casing it is the thickness e itself, and a
    thicker lining might have been used deeper.
    """
    if not wear > 0.0:
        return 0.0
    pressed = wear * (lining.elastic_modulus + lining.plastic_modulus) + lining.thickness * lining.yield_stress
    return float(min(pressed / lining.elastic_modulus, lining.thickness))


def friction_direction(tangential: Any, meridional: Any, length: Any = 1.0) -> tuple[Any, Any]:
    """Vectors of a `length`, opposite to the sliding of nodes over the casing, as friction is; zero where nothing slides.

    `tangential`, `meridional`: parts of the sliding velocity, or of the sliding in one step, in any one unit.
    """
    size = np.sqrt(tangential * tangential + meridional * meridional)
    opposite = np.where(size > 0.0, -1.0 / size, 0.0) * length
    return tangential * opposite, meridional * opposite
