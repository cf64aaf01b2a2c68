"""The cost of a sweep as an extension."""

from __future__ import annotations

from r37core.plans.extension import Extension

from .plan import targets
from .section import SECTION

EXTENSION = Extension(
    name="estimate",
    section=SECTION,
    targets=targets,
    captions={
        "estimate": "Core hours of the whole sweep, projected from a sample of its runs, by what they are spent on.",
    },
    closing="estimate.closing.closing",
    made_on_request=True,
)
