"""The paper's numbers and statements (validation/published.py) checked against runs of ours.

Every function takes responses by the names of windows of speeds, and leaves out what was not run. So the same checks serve
the published step, the shipped level and every choice varied.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import published
import xarray as xr
from published import BLADES, DIRECT_PEAK, FIRST_YIELD, INTERACTIONS, OVERTAKES, QUIET, REFERENCE, VARIANTS

from r37core.results import measures as read

from . import benchmark_measures as own
from .checks import Check, claim
from .last_revolution import width_above_yield
from .published_windows import BARE, REACH

Runs = Mapping[str, xr.Dataset]

PEAK_WITHIN, CAMPBELL_WITHIN, DIRECT_WITHIN = 0.006, 0.003, 0.01
_COUNTED_WITHIN = 0.2
"""Of numbers of revolutions and of a width, which the paper gives roughly, and which 0.1% of friction moves."""

PROTOTYPE = "(prototype)"
"""End of the names of numbers that are not published: slopes of an earlier prototype of the benchmark."""

_MOTION = {
    "L": (0.7, 1.0, "slightly less", True),
    "S": (0.0, 0.7, "dramatically less", False),
    "C": (1.0, 1.3, "slightly more", True),
}
"""Variants' initial -> bounds of the normal motion as a share of Ref's, in words; whether the tangential one is larger."""

_CLEARANCES = {
    ("1B", "L"): (0.6, 1.0, "slightly smaller than"),
    ("1B", "S"): (0.0, 0.6, "significantly smaller than"),
    ("1B", "CS"): (1.0, 1.4, "slightly larger than"),
    ("1T", "L"): (0.85, 1.0, "slightly smaller than"),
    ("1T", "S"): (0.0, 0.85, "dramatically smaller than"),
    ("1T", "CS"): (0.95, 1.05, "the same as"),
}
"""Mode and variants -> bounds of the dynamic clearance's slope as a share of Ref's, in words."""

_AT = INTERACTIONS[0].peak
_MAIN = INTERACTIONS[0].name


def window_checks(runs: Runs) -> list[Check]:
    """All checks that windows about the interactions allow, by window."""
    checks = interaction_checks(runs)
    if _MAIN in runs:
        checks += reference_checks(runs)
    if BARE in runs:
        checks += direct_checks(runs[BARE])
    if _MAIN in runs and BARE in runs:
        checks += scene_checks(runs[_MAIN], runs[BARE])
    if all(f"{blade}_4" in runs for blade in BLADES):
        checks += blade_checks(runs)
    return checks + variant_checks(runs)


def interaction_checks(runs: Runs) -> list[Check]:
    """Peak, drop and lobes of every interaction."""
    checks = []
    for row, run in _interactions(runs):
        drop = read.drop_after(run)
        checks += [
            Check(f"{row.label}: peak", row.peak, read.peak_speed(run), "rad/s", PEAK_WITHIN),
            claim(f"{row.label}: drop after the peak", drop > 0.5, _percent(drop)),
            Check(
                f"{row.label}: lobes of the wear at the peak",
                float(row.engine_order),
                own.strongest_lobes(read.peak_of(run)),
                "",
                0.0,
            ),
        ]
    return checks


def _interactions(runs: Runs) -> list[tuple[published.PublishedInteraction, xr.Dataset]]:
    """The published interactions that were run, each with its run."""
    return [(row, runs[row.name]) for row in INTERACTIONS if row.name in runs]


def reference_checks(runs: Runs) -> list[Check]:
    """The reference blade in the lined scene."""
    run = runs[_MAIN]
    peaks = [read.peak_of(about) for row, about in _interactions(runs) if row.blade == REFERENCE]
    through = all(float(peak["casing_hits"]) > 0 for peak in peaks)
    width, first = width_above_yield(run), _first_yield(run, _AT)
    contact = float(own.first_contact(run)[int(np.argmax(read.motion(run)))]) - 1.0
    worn = max(float(peak["max_wear"]) for peak in peaks)
    return [
        Check("Ref 1B/4: width above yield", published.WIDTH_ABOVE_YIELD, width, "rad/s", _COUNTED_WITHIN),
        Check(f"Ref lined at {_AT:g}: first yield", FIRST_YIELD["lined"], first, "revolutions", _COUNTED_WITHIN),
        Check("Ref lined: whole revolutions before the first contact", published.FIRST_CONTACT, contact, "", _COUNTED_WITHIN),
        claim("Ref lined: worn through at every interaction, the tip on the casing", through),
        _below_yield("Ref lined", run),
        Check("Ref lined: deepest wear at the interactions", 1e3 * published.LINING_THICKNESS, 1e3 * worn, "mm"),
    ]


def direct_checks(run: xr.Dataset) -> list[Check]:
    """The reference blade in direct contact."""
    peak = read.peak_of(run)
    speed, largest = float(peak["speed"]), float(read.motion(peak))
    last, share = own.steepest_fall(run)
    above = read.motion(run.sel(speed=slice(1.03 * speed, None)))
    shares = [float(choose(above) / largest) if above.size else np.nan for choose in (np.median, np.max)]
    low, first = f"{_percent(shares[0])}, at most {_percent(shares[1])}", _first_yield(run, DIRECT_PEAK)
    return [
        Check("direct: largest rms, normal and tangential together", DIRECT_PEAK, speed, "rad/s", DIRECT_WITHIN),
        Check("direct: last speed before the drop", DIRECT_PEAK, last, "rad/s", DIRECT_WITHIN),
        claim("direct: the drop loses more than 30% from one speed to the next", share > 0.3, _percent(share)),
        claim("direct: low above, its median less than half", shares[0] < 0.5, low),
        Check(f"direct at {DIRECT_PEAK:g}: first yield, shortly before", FIRST_YIELD["direct"], first, "revolutions", 0.1),
        _below_yield("direct", run),
    ]


def scene_checks(lined: xr.Dataset, direct: xr.Dataset) -> list[Check]:
    """Both scenes of the reference blade side by side."""
    ratio = float(np.nanmax(own.history_of(lined, QUIET)) / np.nanmax(own.history_of(direct, QUIET)))
    passes = own.overtakes(own.history_of(lined, _AT), own.history_of(direct, _AT))
    return [
        claim(f"at {QUIET:g}: lined far below direct contact in stress", ratio < 0.5, f"{ratio:.2f} of it"),
        Check(f"at {_AT:g}: lined passes direct contact in stress", OVERTAKES, passes, "revolutions", _COUNTED_WITHIN),
    ]


def blade_checks(runs: Runs) -> list[Check]:
    """The variants against the reference blade, each at its own 1B/4 peak."""
    peaks = {blade: read.leading_edge(read.peak_of(runs[f"{blade}_4"])) for blade in BLADES}
    stress = {blade: float(peak["max_von_mises_last_revolution"]) for blade, peak in peaks.items()}
    ratio = stress[REFERENCE] / stress["S100"]
    far = ratio > published.S100_STRESS_BELOW
    checks = [claim("stress at the peak: S100 more than three times below Ref", far, f"{ratio:.1f} times")]
    for blade in VARIANTS:
        normal, tangential = (float(peaks[blade][name] / peaks[REFERENCE][name]) for name in ("rms_normal", "rms_tangential"))
        low, high, words, more = _MOTION[blade[0]]
        at, word = f"{blade} at its peak:", "more" if more else "less"
        checks += [
            claim(f"{at} normal motion {words} than Ref's", low < normal < high, f"{normal:.2f} of it"),
            claim(f"{at} tangential motion {word} than Ref's", (tangential > 1.0) == more, f"{tangential:.2f} of it"),
        ]
    return checks


def variant_checks(runs: Runs) -> list[Check]:
    """The paper's range of the variants' first yields, of ours at our peaks."""
    firsts = []
    for row, run in _interactions(runs):
        speed = float(read.peak_of(run)["speed"])
        if row.blade in VARIANTS and "max_von_mises_history" in run and speed in run["history_speed"]:
            firsts.append(_first_yield(run, speed))
    firsts = [first for first in firsts if np.isfinite(first)]
    if not firsts:
        return []
    ends = zip(("earliest", "latest"), published.VARIANTS_FIRST_YIELD, (min(firsts), max(firsts)), strict=True)
    names = "variants at their peaks: {} first yield"
    return [Check(names.format(words), value, ours, "revolutions", _COUNTED_WITHIN) for words, value, ours in ends]


def survey_checks(runs: Runs, about: Runs) -> list[Check]:
    """The whole range of speeds: `runs` by blade and scene; `about`: the windows about the interactions."""
    lined, direct, other = (runs[name] for name in ("Ref_lined", "Ref_direct", "CS100_lined"))
    outside = read.leading_edge(lined)[["rms_radial", "rms_normal"]]
    for row in INTERACTIONS:
        if row.blade == REFERENCE:
            low, high = ((1.0 + share) * row.campbell for share in (-0.01, REACH))
            outside = outside.where((outside["speed"] < low) | (outside["speed"] > high), drop=True)
    rest, normal = (1e3 * float(outside[name].max()) for name in ("rms_radial", "rms_normal"))
    counts = [own.interactions_above(run, published.LARGEST_ELSEWHERE) for run in (other, lined)]
    widths = [width_above_yield(run) for run in (about["CS100_4"], about[_MAIN])]
    low, lows = rest < 1e3 * published.LARGEST_ELSEWHERE, f"{rest:.2g} mm; normal to the casing {normal:.2g}"
    more = "CS100 has more responses above 0.8 mm, normal to the casing, than Ref"
    return [
        claim("Ref lined, 750 to 2000: no other rms above 0.8 mm, radial", low, lows),
        _median("lined", lined),
        _median("direct", direct),
        Check("Ref lined: response of the torsion near", published.TORSION, torsion_speed(lined), "rad/s"),
        claim(more, counts[0] > counts[1], f"{counts[0]} and {counts[1]}"),
        claim("CS100 has a wider one than Ref", widths[0] > widths[1], "{:.0f} and {:.0f} rad/s above yield".format(*widths)),
    ]


def _median(scene: str, run: xr.Dataset) -> Check:
    """Median rms of the radial displacement, which is counted once, and of the normal one, as "radial" is read elsewhere."""
    radial, normal = (1e3 * own.median_over_speed(run, f"rms_{direction}") for direction in ("radial", "normal"))
    name = f"Ref {scene}, 750 to 2000: median rms, radial"
    return Check(name, 1e3 * published.MEDIAN[scene], radial, "mm", 0.5, f"normal to the casing {normal:.2g}")


def torsion_speed(run: xr.Dataset) -> float:
    """Speed (rad/s) within 2% of the published one of the largest local maximum of the normal rms; NaN if there is none."""
    near = read.leading_edge(run).sel(speed=slice(0.98 * published.TORSION, 1.02 * published.TORSION))
    level = near["rms_normal"].values
    inner = np.flatnonzero((level[1:-1] > level[:-2]) & (level[1:-1] > level[2:])) + 1
    return float(near["speed"][inner[np.argmax(level[inner])]]) if len(inner) else np.nan


def structure_checks(geometry: xr.Dataset, campbells: Mapping[str, xr.Dataset]) -> list[Check]:
    """Shape of the reference blade, Campbell diagrams by blade, dynamic clearance."""
    checks = _shape_checks(geometry)
    for row in INTERACTIONS:
        ours = float(campbells[row.blade]["crossing_speed"].sel(mode="1B", engine_order=row.engine_order))
        checks.append(Check(f"{row.label}: Campbell", row.campbell, ours, "rad/s", CAMPBELL_WITHIN))
    return checks + _clearance_checks(campbells)


def _shape_checks(geometry: xr.Dataset) -> list[Check]:
    span = np.round(100.0 * geometry["span"].values).astype(int)
    areas = dict(zip(span, 1e4 * geometry["section_area"].values, strict=True))
    return [
        *(Check(f"area of the profile at {at}%", value, float(areas[at]), "cm2") for at, value in published.AREAS_CM2.items()),
        Check("volume of the blade", published.VOLUME_CM3, 1e6 * float(geometry["volume"]), "cm3"),
    ]


def _clearance_checks(campbells: Mapping[str, xr.Dataset]) -> list[Check]:
    """The prototype's slopes, and what the paper says of its curves."""
    checks, slopes = [], {}
    for mode, prototype in published.CLEARANCE_SLOPES.items():
        for blade, value in prototype.items():
            slopes[mode, blade] = ours = own.slope_of_clearance(campbells[blade], mode)
            # the prototype's are printed in thousandths
            within = max(0.01, 0.0006 / value)
            checks.append(Check(f"{blade}: slope of {mode}'s dynamic clearance {PROTOTYPE}", value, ours, "", within))
    for (mode, family), (low, high, words) in _CLEARANCES.items():
        ratios = [slopes[mode, f"{family}{degree}"] / slopes[mode, REFERENCE] for degree in (50, 100)]
        detail = " and ".join(f"{ratio:.2f}" for ratio in ratios) + " of it"
        name = f"{mode}'s dynamic clearance of {family}50 and {family}100: {words} Ref's"
        checks.append(claim(name, all(low <= ratio <= high for ratio in ratios), detail))
    return checks


def _first_yield(run: xr.Dataset, speed: float) -> float:
    return read.first_yield(own.history_of(run, speed), float(run["yield_stress"]))


def _below_yield(scene: str, run: xr.Dataset) -> Check:
    largest, limit = float(np.nanmax(own.history_of(run, QUIET))), float(run["yield_stress"])
    return claim(f"{scene} at {QUIET:g}: below yield in the whole run", largest < limit, f"{1e-9 * largest:.2g} GPa")


def _percent(share: float) -> str:
    return f"{100 * share:.0f}%" if np.isfinite(share) else "none"
