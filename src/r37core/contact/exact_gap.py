"""Where a displaced tip node is, seen from the casing. Formulas for arrays; time integration compiles them as they stand."""

from __future__ import annotations

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
    from_axis = np.sqrt(along_radius * along_radius + tangential * tangential)
    excess = tangential * tangential / (from_axis + along_radius)
    return normal + cosine * excess, np.arctan2(tangential, along_radius)


def lobe_shape(theta: Any, period: float, width: float) -> Any:
    """f(theta) of the lobed casing for angles (rad): one lobe in each `period` (rad), `width` relative to it.

    f = exp(-[((theta mod p)/p - 1/2)/width]^2). Source: section 5 of the benchmark.
    """
    return np.exp(-((((theta % period) / period - 0.5) / width) ** 2))
