"""Measures of a design that objectives and constraints of a search can name."""

MINIMISED = (
    "length_dangerous_rad_s", "length_unknown_rad_s", "length_most_revolutions_rad_s", "largest_median_stress_pa",
    "largest_stress_inside_pa", "largest_goodman_share", "exceedance_integral_rad_s", "goodman_integral_rad_s",
    "widest_range_rad_s", "largest_rms_m", "diverged_runs", "length_dangerous_operating_rad_s",
    "length_most_revolutions_operating_rad_s", "exceedance_integral_operating_rad_s", "goodman_integral_operating_rad_s",
)  # fmt: skip
"""Columns of ranking.csv that searches can minimise."""

STRUCTURE_MEASURES: dict[str, tuple[str, tuple[str, ...], tuple[str, ...]]] = {
    "mass_kg": ("mass of the blade", (), ()),
    "frequency_hz": ("frequency of a mode at rest, or at a speed", ("mode",), ("speed_rad_s",)),
    "crossing_margin_percent": (
        "distance of a mode's crossing with an engine order from a speed",
        ("mode", "engine_order", "speed_rad_s"),
        (),
    ),
    "clearance_loss_m": ("largest loss of clearance as the tip swings along a mode", ("mode",), ()),
    "static_stress_pa": ("largest stress by rotation alone, in the region of the stress", (), ("speed_rad_s",)),
}
"""Measure that needs no simulation -> what it is, in words; keys that have to stand beside it, and those that may."""

MEASURES = {**dict.fromkeys(MINIMISED, ("", ("scenes",), ())), **STRUCTURE_MEASURES}
"""The same of all measures."""

FATIGUE_MEASURES = tuple(name for name in MINIMISED if "goodman" in name)
"""Measures that need fatigue among a scene's results."""

IN_OPERATION = tuple(name for name in MINIMISED if "operating" in name)
"""Measures that need an operating range."""

OF_ENDED_RUNS = ("largest_median_stress_pa", "largest_rms_m", "largest_goodman_share")
"""Measures in which a run that diverged has no number: with one they are infinite, so that divergence is never better."""
