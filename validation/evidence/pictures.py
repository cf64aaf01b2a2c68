"""Pictures of pages that are figures of a run."""

import shutil
from typing import Any


def of_run(input: Any, output: Any, params: Any) -> None:
    """A figure as it is. Input: figure. Output: picture."""
    shutil.copyfile(input.figure, output.picture)
