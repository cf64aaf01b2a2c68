"""A table by number of a blade, as in `longer_m: { 1: 2.0e-5 }`; the number may stand as a number or as text."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping
from typing import Annotated, Any, TypeVar

from pydantic import BeforeValidator, ValidatorFunctionWrapHandler, WithJsonSchema, WrapValidator

from .section import refused

T = TypeVar("T")

MOST_BLADES = 1000


def _number(key: Any) -> str:
    """The number of a blade as text without leading zeros; raises the error of a key that is none."""
    text = str(key).lstrip("0") if isinstance(key, str) or type(key) is int else ""
    if not re.fullmatch("[1-9][0-9]{0,3}", text) or int(text) > MOST_BLADES:
        raise refused((), f"the key {key!r}", f"the number of a blade, from 1 to {MOST_BLADES}")
    return text


def _by_number(table: Any, checked: ValidatorFunctionWrapHandler) -> dict[str, Any]:
    """The table as it is checked; raises the error of what is no table, and of two values of a blade."""
    if not isinstance(table, Mapping):
        raise refused((), repr(table), "a value for each number of a blade, as in {1: 0.4, 2: -0.7}")
    values: dict[str, Any] = checked(table)
    twice = [number for number, times in Counter(map(_number, table)).items() if times > 1]
    if twice:
        raise refused((), f"blade {twice[0]} twice", "each blade once")
    return values


_Number = Annotated[str, BeforeValidator(_number), WithJsonSchema({"type": "string", "pattern": "^[0-9]+$"})]

BladeTable = Annotated[dict[_Number, T], WrapValidator(_by_number)]
"""Values by numbers of blades, which are the texts "1", "2", ... of a checked table."""
