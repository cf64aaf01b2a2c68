"""The registry of the extensions: a capability is one folder of this package, one file of rules, and one line here."""

from importlib import import_module
from itertools import chain

from r37core.config import Settings
from r37core.plans.extension import Extension
from r37core.plans.extent import Pair

FOLDERS = (
    "exports",
    "shapes",
    "signals",
    "run_ups",
    "second_motions",
    "rotors",
    "designs",
    "requirements",
    "tolerances",
    "search",
    "trials",
)
"""Folders of the extensions, in the order of their sections in docs/configuration.md."""


def _declared(folder: str) -> tuple[Extension, ...]:
    plan = import_module(f"r37core.{folder}.plan")
    return plan.EXTENSIONS if hasattr(plan, "EXTENSIONS") else (plan.EXTENSION,)


EXTENSIONS: tuple[Extension, ...] = tuple(chain.from_iterable(map(_declared, FOLDERS)))
"""All extensions: one of each folder, or several that share its rules."""


def simulations_of_members(settings: Settings) -> dict[Pair, int]:
    """Largest number of simulations of members, by blade and scene."""
    return {pair: number for extension in EXTENSIONS for pair, number in extension.members(settings).items()}
