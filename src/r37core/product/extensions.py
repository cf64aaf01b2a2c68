"""The extensions of the installed packages. The configuration is read with the sections and checks of all of them."""

from importlib import import_module
from itertools import chain

from r37core.base.packages import registered
from r37core.config import Settings
from r37core.config.config_file import Config, config_model
from r37core.config.cross_checks import CHECKS
from r37core.config.reading import Reader
from r37core.plans.extension import Extension
from r37core.plans.extent import Extent, extent_of


def _declared(module: str) -> tuple[Extension, ...]:
    plan = import_module(module)
    return plan.EXTENSIONS if hasattr(plan, "EXTENSIONS") else (plan.EXTENSION,)


EXTENSIONS: tuple[Extension, ...] = tuple(chain.from_iterable(map(_declared, registered("EXTENSIONS").values())))
"""All extensions: one of each folder, or several that share its rules."""


def whole_extent(settings: Settings) -> Extent:
    """Simulations of a whole run, those of all extensions included."""
    return extent_of(settings, {extension.name: extension.runs(settings) for extension in EXTENSIONS})


CONFIG: type[Config] = config_model([extension.section for extension in EXTENSIONS if extension.section])
"""config.yaml with the section of each extension."""

RESERVED = ("figures", "cases", "runs", *(extension.name for extension in EXTENSIONS))
"""Folders of the results beside those of the blades."""


def blades_are_no_other_folders(settings: Settings) -> None:
    """No blade, nor design of a family, is called like a folder of something else."""
    family_of = settings.designs.family_of
    for name in settings.designs.entries:
        if name.lower() in RESERVED:
            what = f"the {'design' if name in family_of else 'blade'} '{name}'"
            allowed = f"another name; {', '.join(RESERVED)} are folders of the results"
            raise settings.designs.document.refusal(what, allowed, family_of.get(name, name))


READER = Reader(CONFIG, (blades_are_no_other_folders, *CHECKS, *(check for each in EXTENSIONS for check in each.checks)))

read_settings, settings_of_run, load_settings = READER.read_settings, READER.settings_of_run, READER.load_settings
