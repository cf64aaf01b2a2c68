"""The paper's numbers and statements (r37core.published) checked against the runs of a modelling choice.

Every function takes responses by the names of the windows, and leaves out what a choice did not run, so that the same checks
serve what is shipped, its numerical variants and every choice varied.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import xarray as xr

from r37core.published import (
    AREAS_CM2,
    BLADES,
    CLEARANCE_SLOPES,
    DIRECT_PEAK,
    FIRST_CONTACT,
    FIRST_YIELD,
    INTERACTIONS,
    LARGEST_ELSEWHERE,
    LINING_THICKNESS,
    MEDIAN,
    OVERTAKES,
    QUIET,
    REFERENCE,
    S100_STRESS_BELOW,
    TORSION,
    VARIANTS,
    VARIANTS_FIRST_YIELD,
    VOLUME_CM3,
    WIDTH_ABOVE_YIELD,
)
from r37core.results import measures as read

from ..checks import Check, claim
from .cases import CONVERGENCE, DIRECT, FINE_WINDOW, SHIPPED, SURVEY

Runs = Mapping[str, xr.Dataset]

PEAK_WITHIN, CAMPBELL_WITHIN, DIRECT_WITHIN = 0.006, 0.003, 0.01
_COUNTED_WITHIN = 0.2
"""Of numbers of revolutions and of a width, which the paper gives roughly, and which 0.1% of friction moves."""

_AT = INTERACTIONS[0].peak
_MAIN = INTERACTIONS[0].name


def shipped_checks(geometry: xr.Dataset, campbells: Mapping[str, Runs], runs: Mapping[str, Runs]) -> list[Check]:
    """All checks of what is shipped; `campbells` by blade and mesh (`level`: its own), `runs` by choice and window."""
    level = {blade: meshes["level"] for blade, meshes in campbells.items() if "level" in meshes}
    checks = structure_checks(geometry, level) + choice_checks(runs[SHIPPED])
    return checks + survey_checks(runs[SURVEY], runs[SHIPPED])


def convergence_checks(campbells: Mapping[str, Runs], runs: Mapping[str, Runs]) -> dict[str, list[Check]]:
    """The same checks, as far as they were run, with one numerical choice changed."""
    checks = {}
    for name in CONVERGENCE:
        mesh = name.removeprefix("mesh_")
        structure = {REFERENCE: campbells[REFERENCE][mesh]} if mesh in campbells[REFERENCE] else {}
        checks[name] = choice_checks(runs[name]) + structure_checks(None, structure)
    return checks


def choice_checks(runs: Runs) -> list[Check]:
    """All checks of one choice's runs, by window."""
    checks = interaction_checks(runs)
    if _MAIN in runs:
        checks += reference_checks(runs)
    if DIRECT in runs:
        checks += direct_checks(runs[DIRECT])
    if _MAIN in runs and DIRECT in runs:
        checks += scene_checks(runs[_MAIN], runs[DIRECT])
    if all(f"{blade}_4" in runs for blade in BLADES):
        checks += blade_checks(runs)
    return checks + variant_checks(runs)


def interaction_checks(runs: Runs) -> list[Check]:
    """Peak, drop and lobes of every interaction."""
    checks = []
    for row in INTERACTIONS:
        if row.name not in runs:
            continue
        run, name = runs[row.name], f"{row.blade} 1B/{row.engine_order}"
        speed, drop, lobes = read.peak_speed(run), read.drop_after(run), float(read.strongest_lobes(read.peak_of(run)))
        checks.append(Check(f"{name}: peak", row.peak, speed, "rad/s", PEAK_WITHIN))
        checks.append(claim(f"{name}: drop after the peak", drop > 0.5, _percent(drop)))
        checks.append(Check(f"{name}: lobes of the wear at the peak", float(row.engine_order), lobes, "", 0.0))
    return checks


def reference_checks(runs: Runs) -> list[Check]:
    """The reference blade in the lined scene."""
    run = runs[_MAIN]
    peaks = [read.peak_of(runs[row.name]) for row in INTERACTIONS if row.blade == REFERENCE and row.name in runs]
    worn = max(float(peak["max_wear"]) for peak in peaks)
    through = all(float(peak["casing_hits"]) > 0 for peak in peaks)
    width, first = read.width_above_yield(run), _first_yield(run, _AT)
    contact = float(read.first_contact(run)[int(np.argmax(read.motion(run)))]) - 1.0
    return [
        Check("Ref 1B/4: width above yield", WIDTH_ABOVE_YIELD, width, "rad/s", _COUNTED_WITHIN),
        Check(f"Ref lined at {_AT:g}: first yield", FIRST_YIELD["lined"], first, "revolutions", _COUNTED_WITHIN),
        Check("Ref lined: whole revolutions before the first contact", FIRST_CONTACT, contact, "", _COUNTED_WITHIN),
        claim("Ref lined: worn through at every interaction, the tip on the casing", through),
        Check("Ref lined: deepest wear at the interactions", 1e3 * LINING_THICKNESS, 1e3 * worn, "mm"),
        _below_yield("Ref lined", run),
    ]


def direct_checks(run: xr.Dataset) -> list[Check]:
    """The reference blade in direct contact."""
    peak = read.peak_of(run)
    speed, largest = float(peak["speed"]), float(read.motion(peak))
    last, share = read.steepest_fall(run)
    above = read.motion(run.sel(speed=slice(1.03 * speed, None)))
    shares = [float(choose(above) / largest) if above.size else np.nan for choose in (np.median, np.max)]
    first = _first_yield(run, DIRECT_PEAK)
    return [
        Check("direct: largest rms, normal and tangential together", DIRECT_PEAK, speed, "rad/s", DIRECT_WITHIN),
        Check("direct: last speed before the drop", DIRECT_PEAK, last, "rad/s", DIRECT_WITHIN),
        claim("direct: the drop loses more than 30% from one speed to the next", share > 0.3, _percent(share)),
        claim(
            "direct: low above, its median less than half",
            shares[0] < 0.5,
            f"{_percent(shares[0])}, at most {_percent(shares[1])}",
        ),
        Check(f"direct at {DIRECT_PEAK:g}: first yield, shortly before", FIRST_YIELD["direct"], first, "revolutions", 0.1),
        _below_yield("direct", run),
    ]


def scene_checks(lined: xr.Dataset, direct: xr.Dataset) -> list[Check]:
    """Both scenes of the reference blade side by side."""
    ratio = float(np.nanmax(read.history_of(lined, QUIET)) / np.nanmax(read.history_of(direct, QUIET)))
    passes = read.overtakes(read.history_of(lined, _AT), read.history_of(direct, _AT))
    return [
        claim(f"at {QUIET:g}: lined far below direct contact in stress", ratio < 0.5, f"{ratio:.2f} of it"),
        Check(f"at {_AT:g}: lined passes direct contact in stress", OVERTAKES, passes, "revolutions", _COUNTED_WITHIN),
    ]


def blade_checks(runs: Runs) -> list[Check]:
    """The variants against the reference blade, each at its own 1B/4 peak."""
    peaks = {blade: read.leading_edge(read.peak_of(runs[f"{blade}_4"])) for blade in BLADES}
    stress = {blade: float(peak["max_von_mises"]) for blade, peak in peaks.items()}
    ratio = stress[REFERENCE] / stress["S100"]
    checks = [
        claim("stress at the peak: S100 more than three times below Ref", ratio > S100_STRESS_BELOW, f"{ratio:.1f} times")
    ]
    for blade in VARIANTS:
        normal, tangential = (float(peaks[blade][name] / peaks[REFERENCE][name]) for name in ("rms_normal", "rms_tangential"))
        low, high, words = {
            "L": (0.7, 1.0, "slightly less"),
            "S": (0.0, 0.7, "dramatically less"),
            "C": (1.0, 1.3, "slightly more"),
        }[blade[0]]
        more = blade[0] != "S"
        checks.append(
            claim(f"{blade} at its peak: normal motion {words} than Ref's", low < normal < high, f"{normal:.2f} of it")
        )
        word = "more" if more else "less"
        checks.append(
            claim(
                f"{blade} at its peak: tangential motion {word} than Ref's",
                (tangential > 1.0) == more,
                f"{tangential:.2f} of it",
            )
        )
    return checks


def variant_checks(runs: Runs) -> list[Check]:
    """Width above yield and first yield at our peak where a window is wide; the paper's range of the variants' first yields."""
    checks, firsts = [], []
    for row in INTERACTIONS:
        if row.name not in runs or "max_von_mises_history" not in runs[row.name]:
            continue
        run, name = runs[row.name], f"{row.blade} 1B/{row.engine_order}"
        speed = float(read.peak_of(run)["speed"])
        if speed not in run["history_speed"]:
            continue
        first = _first_yield(run, speed)
        if row.name != _MAIN:
            width, share = read.width_above_yield(run), read.speeds_above_yield(run).share
            detail = f"{_percent(share)} of it above" if share < 0.995 else ""
            checks.append(Check(f"{name}: width above yield", None, width, "rad/s", detail=detail))
        checks.append(Check(f"{name}: first yield at our peak", None, first, "revolutions"))
        if row.blade in VARIANTS and np.isfinite(first):
            firsts.append(first)
    for words, published, choose in zip(("earliest", "latest"), VARIANTS_FIRST_YIELD, (min, max), strict=True):
        if firsts:
            name = f"variants at their peaks: {words} first yield"
            checks.append(Check(name, published, choose(firsts), "revolutions", _COUNTED_WITHIN))
    return checks


def survey_checks(runs: Runs, shipped: Runs) -> list[Check]:
    """The whole range of speeds: `runs` of the survey; `shipped`: the windows about the interactions."""
    lined, direct, other = (runs[name] for name in ("Ref_lined", "Ref_direct", "CS100_lined"))
    outside = read.leading_edge(lined)[["rms_radial", "rms_normal"]]
    for row in INTERACTIONS:
        if row.blade == REFERENCE:
            low, high = ((1.0 + share) * row.campbell for share in (FINE_WINDOW[0] - 0.01, FINE_WINDOW[1]))
            outside = outside.where((outside["speed"] < low) | (outside["speed"] > high), drop=True)
    rest, normal = (1e3 * float(outside[name].max()) for name in ("rms_radial", "rms_normal"))
    counts = [read.interactions_above(run, LARGEST_ELSEWHERE) for run in (other, lined)]
    widths = [read.width_above_yield(run) for run in (shipped["CS100_4"], shipped[_MAIN])]
    torsion = torsion_speed(lined)
    return [
        claim(
            "Ref lined, 750 to 2000: no other rms above 0.8 mm, radial",
            rest < 1e3 * LARGEST_ELSEWHERE,
            f"{rest:.2g} mm; normal to the casing {normal:.2g}",
        ),
        _median("lined", lined),
        _median("direct", direct),
        Check("Ref lined: response of the torsion near", TORSION, torsion, "rad/s"),
        claim(
            "CS100 has more responses above 0.8 mm, normal to the casing, than Ref",
            counts[0] > counts[1],
            f"{counts[0]} and {counts[1]}",
        ),
        claim(
            "CS100 has a wider one than Ref", widths[0] > widths[1], f"{widths[0]:.0f} and {widths[1]:.0f} rad/s above yield"
        ),
    ]


def _median(scene: str, run: xr.Dataset) -> Check:
    """Median rms of the radial displacement, which is counted once, and of the normal one, as "radial" is read elsewhere."""
    radial, normal = (1e3 * read.median_over_speed(run, f"rms_{direction}") for direction in ("radial", "normal"))
    name = f"Ref {scene}, 750 to 2000: median rms, radial"
    return Check(name, 1e3 * MEDIAN[scene], radial, "mm", 0.5, f"normal to the casing {normal:.2g}")


def torsion_speed(run: xr.Dataset) -> float:
    """Speed (rad/s) within 2% of the published one of the largest local maximum of the normal rms; NaN if there is none."""
    near = read.leading_edge(run).sel(speed=slice(0.98 * TORSION, 1.02 * TORSION))
    level = near["rms_normal"].values
    inner = np.flatnonzero((level[1:-1] > level[:-2]) & (level[1:-1] > level[2:])) + 1
    return float(near["speed"][inner[np.argmax(level[inner])]]) if len(inner) else np.nan


def structure_checks(geometry: xr.Dataset | None, campbells: Mapping[str, xr.Dataset]) -> list[Check]:
    """Shape of the reference blade, Campbell diagrams by blade, dynamic clearance."""
    checks = [] if geometry is None else _shape_checks(geometry)
    for row in INTERACTIONS:
        if row.blade in campbells:
            ours = float(campbells[row.blade]["crossing_speed"].sel(mode="1B", engine_order=row.engine_order))
            checks.append(Check(f"{row.blade} 1B/{row.engine_order}: Campbell", row.campbell, ours, "rad/s", CAMPBELL_WITHIN))
    if all(blade in campbells for blade in BLADES):
        checks += _clearance_checks(campbells)
    return checks


def _shape_checks(geometry: xr.Dataset) -> list[Check]:
    span = np.round(100.0 * geometry["span"].values).astype(int)
    areas = dict(zip(span, 1e4 * geometry["section_area"].values, strict=True))
    checks = [
        Check(f"area of the profile at {percent}%", value, float(areas[percent]), "cm2") for percent, value in AREAS_CM2.items()
    ]
    return [*checks, Check("volume of the blade", VOLUME_CM3, 1e6 * float(geometry["volume"]), "cm3")]


def _clearance_checks(campbells: Mapping[str, xr.Dataset]) -> list[Check]:
    """The prototype's slopes, and what the paper says of its curves."""
    checks, slopes = [], {}
    for mode, published in CLEARANCE_SLOPES.items():
        for blade, value in published.items():
            slopes[mode, blade] = read.slope_of_clearance(campbells[blade], mode)
            # the prototype's are printed in thousandths
            within = max(0.01, 0.0006 / value)
            checks.append(
                Check(f"{blade}: slope of {mode}'s dynamic clearance (prototype)", value, slopes[mode, blade], "", within)
            )
    statements = {
        "1B": {
            "L": (0.6, 1.0, "slightly smaller"),
            "S": (0.0, 0.6, "significantly smaller"),
            "CS": (1.0, 1.4, "slightly larger"),
        }
    }
    statements["1T"] = {
        "L": (0.85, 1.0, "slightly smaller"),
        "S": (0.0, 0.85, "dramatically smaller"),
        "CS": (0.95, 1.05, "the same"),
    }
    for mode, families in statements.items():
        for family, (low, high, words) in families.items():
            ratios = [slopes[mode, f"{family}{degree}"] / slopes[mode, REFERENCE] for degree in (50, 100)]
            detail = " and ".join(f"{ratio:.2f}" for ratio in ratios) + " of it"
            name = f"{mode}'s dynamic clearance of {family}50 and {family}100: {words} than Ref's"
            checks.append(claim(name.replace("the same than", "the same as"), all(low <= x <= high for x in ratios), detail))
    return checks


def _first_yield(run: xr.Dataset, speed: float) -> float:
    return read.first_yield(read.history_of(run, speed), float(run["yield_stress"]))


def _below_yield(scene: str, run: xr.Dataset) -> Check:
    largest = float(np.nanmax(read.history_of(run, QUIET)))
    return claim(
        f"{scene} at {QUIET:g}: below yield in the whole run", largest < float(run["yield_stress"]), f"{1e-9 * largest:.2g} GPa"
    )


def _percent(share: float) -> str:
    return f"{100 * share:.0f}%" if np.isfinite(share) else "none"
