"""Time signals as an extension."""

from r37core.plans.extension import Extension

from .plan import signals_have_runs, simulated, targets
from .section import SECTION

_CAPTIONS = {
    "spectrogram": (
        "Blade {blade} in scene {scene}: engine orders of the leading edge's motion and of strain gauges over the revolutions "
        "since the start, at each speed; Hann windows of eight revolutions."
    ),
    "orders": (
        "Blade {blade} in scene {scene}: amplitude of the strongest whole engine orders over the revolutions since the "
        "start, at each speed. Beside them, where there are probes: the leading edge's displacement that tip timing tells."
    ),
    "contact_force": (
        "Blade {blade} in scene {scene}: normal force on the tip, all contact nodes together, over the casing angle of its "
        "leading edge, at each speed. Grey: clearance of the undeformed leading edge, which lobes make smaller."
    ),
}

EXTENSION = Extension(
    name="signals",
    section=SECTION,
    checks=(signals_have_runs,),
    simulated=simulated,
    targets=targets,
    captions=_CAPTIONS,
    closing="signals.dataset.closing",
)
