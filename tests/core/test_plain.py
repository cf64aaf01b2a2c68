"""Dataclasses as plain dictionaries and back: exact, strict, and through JSON."""

import json
from dataclasses import dataclass, fields, replace
from typing import Literal

import defaults
import numpy as np
import pytest

from r37core.adaptive.criterion import RefinementChoice, Window
from r37core.base.plain import PlainError, from_plain, to_plain
from r37core.base.speeds import RefinedRange, SpeedPlan
from r37core.contact.casing import Casing
from r37core.contact.scene import Lining
from r37core.fem.material import Material
from r37core.rom.reduction_choice import ReductionChoice
from r37core.rom.region_choice import RegionChoice

LINING = defaults.Lining(5e-3, 8e9, 2e9, 15e6, bar_width=0.035)
ORIENTATION = defaults.Orientation("mm", (0.0, 0.0, 1.0), (1.0, 0.0, 0.0), "negative")

CASING = defaults.Casing(1e-3)

JOBS_GET = [
    defaults.Scene(defaults.Casing(5e-4), LINING, defaults.Friction(0.15)),
    defaults.Scene(defaults.Casing(5e-4, cone_angle=0.1)),
    defaults.IntegrationChoice(1e-7, 200, 64),
    Material(180e9, 7800.0, 0.3),
    defaults.BoundaryChoice(),
    ReductionChoice((0.0, 900.0), 12, 1e-9, "rotating", 3, True),
    RegionChoice(maximum_z=0.1),
    RefinementChoice((Window("1B", 12, 0.0, 0.1, 5.0),), 0.1, 0.2, 0.3, 0.4, 0.5, 0.6),
    SpeedPlan((900.0, 1000.0), (RefinedRange(900.0, 1.0, 50, 100),)),
    ORIENTATION,
]


@pytest.mark.parametrize("value", JOBS_GET, ids=lambda value: type(value).__name__)
def test_what_jobs_get_comes_back_equal(value):
    written = json.loads(json.dumps(to_plain(value)))
    assert written == to_plain(value)
    assert from_plain(type(value), written) == value
    assert hash(from_plain(type(value), written)) == hash(value)


@pytest.mark.parametrize("value", JOBS_GET, ids=lambda value: type(value).__name__)
def test_every_field_counts(value):
    """A dictionary without one field, or with another beside it, is refused: no default stands in for it."""
    written = to_plain(value)
    for field in fields(value):
        with pytest.raises(PlainError, match=type(value).__name__):
            from_plain(type(value), {name: one for name, one in written.items() if name != field.name})
    with pytest.raises(PlainError, match=rf"{type(value).__name__}: found .*typo"):
        from_plain(type(value), written | {"typo": 1})


def test_numbers_of_numpy_become_plain():
    """Snakemake compares reprs, and that of np.float64 is not that of a float."""
    written = to_plain(Material(np.float64(1.0), 2.0, 0.3))
    assert repr(written["youngs_modulus"]) == "1.0"


@dataclass(frozen=True)
class Every:
    kind: Literal["one", "two"]
    either: Casing | Lining | None
    named: dict[str, tuple[int, float]]
    flags: list[bool]
    number: float


EVERY = Every("one", LINING, {"a": (1, 2.5)}, [True], 1)


def test_every_kind_of_field():
    assert from_plain(Every, to_plain(EVERY)) == EVERY
    assert from_plain(Every, to_plain(replace(EVERY, either=CASING))).either == CASING
    assert from_plain(Every, to_plain(replace(EVERY, either=None))).either is None
    assert from_plain(dict[str, Casing], {"a": to_plain(CASING)}) == {"a": CASING}


@pytest.mark.parametrize(
    ("field", "value"), [("either", {"thickness": 1.0}), ("either", 3), ("named", [1]), ("flags", "text"), ("number", None)]
)
def test_values_of_another_shape_are_refused(field, value):
    with pytest.raises(PlainError, match=rf"found .*{value}"):
        from_plain(Every, to_plain(EVERY) | {field: value})


def test_values_of_another_number_are_refused():
    with pytest.raises(PlainError, match=r"found \[1\]"):
        from_plain(tuple[int, float], [1])


def test_what_has_no_plain_form_is_refused():
    with pytest.raises(PlainError, match=r"Every\.flags\[0\]: found object"):
        to_plain(replace(EVERY, flags=[object()]))
