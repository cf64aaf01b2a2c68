"""Status of a run: how it ended."""

from enum import IntEnum


class Outcome(IntEnum):
    """An outcome of a run, a number in its file."""

    @property
    def text(self) -> str:
        """Outcome as the datasets and tables have it."""
        return self.name.lower()


class RunStatus(Outcome):
    """`NOT_RUN`: a speed that this blade and scene was not asked for, in a dataset where another one was."""

    COMPLETED = 0
    DIVERGED = 1
    NOT_RUN = 2


class MotionKind(Outcome):
    """Kind of a motion.

    `FREE`: without contact; `PERIODIC`: with the period of the casing; `MULTIPLE`: with several of them; `QUASI_PERIODIC`:
    without a period, and neighbours neither part nor meet; `CHAOTIC`: neighbours part exponentially; `CONVERGING`: they meet,
    and the motion has not come back to itself yet; `UNKNOWN`: diverged.
    """

    FREE = 0
    PERIODIC = 1
    MULTIPLE = 2
    QUASI_PERIODIC = 3
    CHAOTIC = 4
    CONVERGING = 5
    UNKNOWN = 6
