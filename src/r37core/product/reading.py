"""Configuration with the sections and checks of all extensions."""

from r37core.config import Settings
from r37core.config.config_file import Config, config_model
from r37core.config.cross_checks import CHECKS
from r37core.config.reading import Reader

from .extensions import EXTENSIONS

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
            raise settings.documents.blades.refusal((family_of.get(name, name),), what, allowed)


READER = Reader(CONFIG, (blades_are_no_other_folders, *CHECKS, *(check for each in EXTENSIONS for check in each.checks)))

read_settings, settings_of_run, load_settings = READER.read_settings, READER.settings_of_run, READER.load_settings
