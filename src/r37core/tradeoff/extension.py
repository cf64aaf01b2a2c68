"""The trade-off of accuracy and cost as an extension."""

from r37core.plans.extension import Extension

from .plan import can_be_run, targets
from .section import SECTION

_CAPTIONS = {
    "tradeoff": (
        "Error of the normal rms at the peak over the CPU time of a run, for every value of every parameter. Each is compared "
        "with the reference value of its parameter. Stars: fidelity levels."
    ),
    "tradeoff_growth": (
        "Growth of a cost with a parameter. Dashed: power law, fitted to the more expensive half of the values."
    ),
    "tradeoff_parameter": (
        "One parameter varied. Above: relative errors of the means over the speeds at the peak, against the reference value. "
        "Below: CPU time of a run."
    ),
}

EXTENSION = Extension(
    name="tradeoff",
    section=SECTION,
    checks=(can_be_run,),
    targets=targets,
    captions=_CAPTIONS,
    closing="tradeoff.tables.closing",
    look_at="<results>/figures/tradeoff.png",
    made_on_request=True,
)
