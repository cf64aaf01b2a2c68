"""Status of a run: how it ended."""

from enum import IntEnum


class RunStatus(IntEnum):
    """`NOT_RUN`: a speed that this blade and scene was not asked for, in a dataset where another one was."""

    COMPLETED = 0
    DIVERGED = 1
    NOT_RUN = 2

    @property
    def text(self) -> str:
        """Status as the datasets and tables have it."""
        return self.name.lower()
