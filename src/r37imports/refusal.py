"""Errors of meshes and matrices from other programs, and their messages."""

import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager

from r37core.base.io import EntryRefused

ASKED = "?"
"""Value of a key whose refusal says what fits."""


UNLESS = "sense_check: false takes the blade as it is"
"""Advice on a blade that is odd and right."""


class ImportRefused(EntryRefused):
    """A mesh or a set of matrices that cannot be used; the message names the file, what was found and what helps.

    `reason`: the message without the lines that help; `key`: of blades.yaml, whose value is to blame; `fitting`: keys and
    values for the blade's entry, as YAML, that would be accepted.
    """

    def __init__(self, reason: str, key: str | None = None, fitting: Mapping[str, str] | None = None):
        lines = "".join(f"\n  {name}: {value}" for name, value in (fitting or {}).items())
        super().__init__(
            f"{reason}; what fits its shape, for its entry in blades.yaml:{lines}\nthen run again" if lines else reason
        )
        self.reason, self.key, self.fitting = reason, key, fitting


class MeshWarning(UserWarning):
    """Something in an imported mesh that works but that the user should know."""


def warn_of(text: str) -> None:
    """Warn of an imported mesh or matrices, from the function that found it."""
    warnings.warn(text, MeshWarning, stacklevel=3)


@contextmanager
def blamed(key: str, file: str | None = None) -> Iterator[None]:
    """Blame `key` for a refusal that names no key yet, and put `file` in front of its message."""
    try:
        yield
    except ImportRefused as error:
        raise ImportRefused(f"{file}: {error.reason}" if file else error.reason, error.key or key, error.fitting) from None


@contextmanager
def kept(refusals: list[ImportRefused], key: str) -> Iterator[None]:
    """Keep a refusal that ends the block, for one message about all that is wrong; `key`: to blame where it names none."""
    try:
        with blamed(key):
            yield
    except ImportRefused as error:
        refusals.append(error)


@contextmanager
def located(locations: Mapping[str, str]) -> Iterator[None]:
    """Put in front of a refusal where its key stands, of `locations` (key -> `file:line: key`)."""
    try:
        yield
    except ImportRefused as error:
        prefix = locations.get(error.key or "")
        raise ImportRefused(f"{prefix}: {error.reason}" if prefix else error.reason, error.key, error.fitting) from None
