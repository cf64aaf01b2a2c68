"""Speeds and other numbers as arguments of a call."""

from collections.abc import Iterable, Mapping
from itertools import islice
from typing import Any

import numpy as np

from r37core.base.io import write_text
from r37core.config import ConfigError
from r37core.config.messages import single_line
from r37core.machine_code.kept import kept_for_user, named_folder

Speeds = Iterable[float | Mapping[str, float]] | Mapping[str, float]
"""Numbers, and ranges `{"start": ..., "stop": ..., "step": ..., "refine_to": ...}` as in config.yaml."""


MOST_SPEEDS = 100_000
"""Speeds and ranges of a call, which may be endless."""


def speed_keys(speeds: Any, speeds_rpm: Any) -> dict[str, list[Any]]:
    """The key of config.yaml that speeds stand under, with plain numbers and ranges, which the configuration checks.

    One of both is given. Raises ConfigError.
    """
    key, unit, several = _single_unit("speeds", speeds, speeds_rpm)
    if isinstance(several, Mapping):
        several = [several]
    if isinstance(several, str | bytes) or not isinstance(several, Iterable):
        raise ConfigError(f"{key}: found {single_line(repr(several))}; allowed: a list of numbers and ranges, in {unit}")
    entries = [*islice(several, MOST_SPEEDS + 1)]
    if len(entries) > MOST_SPEEDS:
        raise ConfigError(f"{key}: found more than {MOST_SPEEDS} values; allowed: at most as many")
    return {key: [_plain_speed(entry, key, unit) for entry in entries]}


def _plain_speed(entry: Any, key: str, unit: str) -> Any:
    if isinstance(entry, Mapping):
        return {name: value if value is None else number(value, f"{key}.{name}", unit) for name, value in entry.items()}
    return number(entry, key, unit)


def speed_key(speed: Any, speed_rpm: Any) -> dict[str, list[Any]]:
    """Key of config.yaml with the one speed of a call; see speed_keys."""
    key, unit, value = _single_unit("speed", speed, speed_rpm)
    return {key.replace("speed", "speeds"): [number(value, key, unit)]}


def _single_unit(name: str, rad_s: Any, rpm: Any) -> tuple[str, str, Any]:
    """Key, unit and value of an argument that is given in rad/s or in rpm. Raises ConfigError for both and for neither."""
    if (rad_s is None) == (rpm is None):
        raise ConfigError(f"{name}: found {'neither' if rpm is None else 'both'}; allowed: {name}, in rad/s, or {name}_rpm")
    return (name, "rad/s", rad_s) if rpm is None else (f"{name}_rpm", "rpm", rpm)


def plain_value(value: Any) -> Any:
    """The value without types of NumPy, inside of mappings and lists, too; a DataFrame becomes a file of the user's cache.

    Raises ConfigError where that cannot be written.
    """
    if hasattr(value, "to_csv"):
        text = value.to_csv(index=False)
        if (file := kept_for_user("table.csv", text, lambda file: write_text(text, file))) is None:
            refusal = f"R37_CACHE: found {named_folder()}, which cannot be written"
            raise ConfigError(f"{refusal}; allowed: a folder for tables from Python")
        return str(file)
    if isinstance(value, Mapping):
        return {key.item() if isinstance(key, np.generic) else key: plain_value(inner) for key, inner in value.items()}
    if isinstance(value, list | tuple):
        return [*map(plain_value, value)]
    if isinstance(value, np.ndarray):
        return value.item() if value.size == 1 else value.tolist()
    return value.item() if isinstance(value, np.generic) else value


def number(value: Any, key: str, unit: str) -> float:
    """A plain number of one that may be NumPy's. Raises ConfigError."""
    plain = plain_value(value)
    if isinstance(plain, bool) or not isinstance(plain, int | float):
        raise ConfigError(f"{key}: found {single_line(repr(value))}; allowed: one number, in {unit}")
    return plain
