"""The cost of a sweep as an extension."""

from r37core.plans.extension import Extension

from .plan import SECTION, targets

EXTENSION = Extension(
    name="estimate",
    section=SECTION,
    targets=targets,
    captions={"estimate": "Core hours of the whole sweep, projected from a sample of its runs, by what they are spent on."},
    closing="estimate.projection.closing",
    made_on_request=True,
)
