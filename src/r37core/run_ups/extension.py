"""Run-ups as an extension."""

from r37core.plans.extension import Extension

from .checks import no_coriolis, no_rotors, run_ups_can_be_done, slowest_speeds_can_be_run
from .plan import remarks, simulated, targets
from .section import SECTION

EXTENSION = Extension(
    name="run_ups",
    section=SECTION,
    checks=(run_ups_can_be_done, slowest_speeds_can_be_run, no_coriolis, no_rotors),
    simulated=simulated,
    targets=targets,
    remarks=remarks,
    captions={
        "run_ups": (
            "Blade {blade} in scene {scene}, run up (solid) and down (dashed) at several rates, the slowest dark. Crosses: the "
            "lining was worn before. Of every revolution over its mean speed: rms of the leading edge's motion normal to the "
            "casing and tangential, largest von Mises stress, and largest wear so far. Dashed line: yield stress; above it "
            "(tinted) the blade is outside the linear model."
        ),
        "run_up_rates": (
            "Largest von Mises stress of every run-up (left) and run-down (right) in scene {scene} against its rate, for every "
            "blade. Tinted: above yield."
        ),
    },
    closing="run_ups.tables.closing",
)
