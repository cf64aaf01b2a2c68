"""The extremes of the configuration as an extension."""

from r37core.plans.extension import Extension

from .plan import SECTION, can_be_run, targets

EXTENSION = Extension(
    name="stability",
    section=SECTION,
    checks=(can_be_run,),
    targets=targets,
    captions={
        "stability": (
            "Extremes of the configuration, each run with its own time step and with half of it. Accurate: both have the same "
            "mean rms within 5%. Degraded: they have not. Diverged: the status of the run reports it. Refused: not run. "
            "Unsound: a wrong number that no status reports."
        )
    },
    closing="stability.judging.closing",
    made_on_request=True,
)
