"""Section curves of blades for tests: those of a blade with profiles, and analytic ones, with files of them."""

import numpy as np


def sections_of(blade, points_per_side=100):
    """Closed curves of a blade's own profiles, arrays (points, 3) in m and in the blade's frame, from hub to tip."""
    curves = []
    for profile, axial, rotation in zip(blade.profiles, blade.placement.axial, blade.placement.rotation, strict=True):
        m, theta = profile.outline(points_per_side)
        r, theta, z = profile.cone.radius(m), theta + rotation, profile.cone.axial(m) + axial
        curves.append(np.stack([r * np.cos(theta), r * np.sin(theta), z], axis=1))
    return curves


def airfoil(count=60, thickness=0.06, camber=0.3, trailing="round"):
    """Closed outline (along, across) of chord 1, from the trailing edge along the upper side and back.

    Parabolic thickness with elliptic ends on a circular arc that turns by `camber` (rad), hollow below; `trailing`: round,
    blunt or sharp.
    """
    share = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, count))
    half = 0.5 * thickness * np.sqrt(np.clip(share, 0.0, None)) * (1.0 - 0.9 * share) * 2.0
    if trailing == "round":
        half = 0.5 * thickness * np.sqrt(np.clip(4.0 * share * (1.0 - share), 0.0, None)) * (1.2 - 0.6 * share)
    elif trailing == "sharp":
        half = half - half[-1] * share
    line = 0.5 * camber * share * (1.0 - share)
    slope = np.arctan(0.5 * camber * (1.0 - 2.0 * share))
    upper = np.stack([share - half * np.sin(slope), line + half * np.cos(slope)], axis=1)
    lower = np.stack([share + half * np.sin(slope), line - half * np.cos(slope)], axis=1)
    outline = np.concatenate([upper[::-1], lower[1:]])
    return outline[:-1] if np.allclose(outline[0], outline[-1]) else outline


def stacked(outline, radii, chords, staggers, turbine=False):
    """Sections of an outline on cylinders, (points, 3) in m, in the blade's frame, where the rotor turns to negative angles.

    `staggers` (rad), positive with the leading edge ahead. The hollow side looks along the rotation, in a `turbine` against it.
    """
    along, across = (outline - [0.5, 0.0]).T
    curves = []
    for radius, chord, stagger in zip(radii, chords, staggers, strict=True):
        side = -across if turbine else across
        z = chord * (along * np.cos(stagger) - side * np.sin(stagger))
        theta = chord * (along * np.sin(stagger) + side * np.cos(stagger)) / radius
        curves.append(np.stack([radius * np.cos(theta), radius * np.sin(theta), z], axis=1))
    return curves


def fan(**changes):
    """A fan: long, thin, strongly twisted."""
    radii = np.linspace(0.15, 0.45, 9)
    outline = airfoil(**{"thickness": 0.05, "camber": 0.25, **changes})
    return stacked(outline, radii, np.linspace(0.1, 0.14, 9), np.radians(np.linspace(20.0, 65.0, 9)))


def turbine(**changes):
    """A turbine: short, thick, strongly cambered, with the hollow side against the rotation."""
    radii = np.linspace(0.30, 0.36, 5)
    outline = airfoil(**{"thickness": 0.16, "camber": 1.6, **changes})
    return stacked(outline, radii, np.full(5, 0.035), np.radians([25.0, 28.0, 31.0, 34.0, 37.0]), turbine=True)


def csv_text(curves, factor=1.0, digits=9):
    """Table of sections in a unit of which there are `factor` in a metre."""
    rows = [
        f"{number}," + ",".join(f"{factor * value:.{digits}f}" for value in point)
        for number, curve in enumerate(curves)
        for point in curve
    ]
    return "\n".join(["section,x,y,z", *rows]) + "\n"


def curve_text(curves, factor=1.0):
    """A profile.curve with closed profiles."""
    parts = []
    for number, curve in enumerate(curves):
        parts += [f"# Profile {number + 1}"]
        parts += ["  ".join(f"{factor * value:.9f}" for value in point) for point in [*curve, curve[0]]]
    return "\n".join(parts) + "\n"


def geomturbo_text(curves, form="XYZ", channel=""):
    """A .geomTurbo with the two sides of each section, split at the ends of its first half."""
    lines = ["GEOMETRY TURBO", "VERSION 5.5", channel, "NI_BEGIN nibladegeometry", "units 1"]
    for side in ("suction", "pressure"):
        lines += [side, "SECTIONAL", str(len(curves))]
        for number, curve in enumerate(curves):
            half = len(curve) // 2
            points = curve[: half + 1] if side == "suction" else np.concatenate([curve[half:], curve[:1]])[::-1]
            if form == "ZRTH":
                points = np.stack([points[:, 2], np.hypot(*points[:, :2].T), np.arctan2(points[:, 1], points[:, 0])], axis=1)
            # AutoBlade's counts carry a sign
            lines += [f"# section {number + 1}", form, f"+{len(points)}"]
            lines += ["\t".join(f"{value:.11f}" for value in point) for point in points]
    return "\n".join([*lines, "NI_END nibladegeometry", "NI_END GEOMTURBO"]) + "\n"


CHANNEL = """NI_BEGIN CHANNEL
NI_BEGIN basic_curve
NAME thehub
DISCRETISATION 10
NI_BEGIN zrcurve
ZR
2
-0.5 0.16
0.5 0.16
NI_END zrcurve
NI_END basic_curve
NI_BEGIN basic_curve
NAME theshroud
NI_BEGIN zrcurve
ZR polyline
3
-0.5 0.450
0.0 0.445
0.5 0.440
NI_END zrcurve
NI_END basic_curve
NI_BEGIN channel_curve hub
NAME hub
VERTEX CURVE_P thehub 0
VERTEX CURVE_P thehub 1
NI_END channel_curve hub
NI_BEGIN channel_curve shroud
NAME shroud
VERTEX CURVE_P theshroud 0
VERTEX CURVE_P theshroud 1
NI_END channel_curve shroud
NI_END CHANNEL"""
