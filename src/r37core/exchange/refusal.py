"""What is raised and said about meshes and matrices from other programs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager


class ImportRefused(ValueError):
    """A mesh or a set of matrices that cannot be used; the message names the file, what was found and what helps.

    `key`: of blades.yaml, whose value is to blame.
    """

    def __init__(self, text: str, key: str | None = None):
        super().__init__(text)
        self.key = key


class MeshWarning(UserWarning):
    """Something in an imported mesh that works but that the user should know."""


@contextmanager
def blamed(key: str, file: str | None = None) -> Iterator[None]:
    """Blame `key` for a refusal that names no key yet, and put `file` in front of its message."""
    try:
        yield
    except ImportRefused as error:
        raise ImportRefused(f"{file}: {error}" if file else str(error), error.key or key) from None


@contextmanager
def placed(places: Mapping[str, str]) -> Iterator[None]:
    """Put in front of a refusal where its key stands, of `places` (key -> `file:line: key`)."""
    try:
        yield
    except ImportRefused as error:
        place = places.get(error.key or "")
        raise ImportRefused(f"{place}: {error}" if place else str(error), error.key) from None
