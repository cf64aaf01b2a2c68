"""Which configuration a call is made with: the shipped one, or one's own."""

import os
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Self

from r37core.config import ConfigError, Document, command_line_document
from r37core.config.config_file import Config
from r37core.config.messages import single_line
from r37core.config.named_files import CONFIG_FILES, named_file, study_folder
from r37core.config.reading import CONFIG_FILE, configuration_file, together
from r37core.product.extensions import CONFIG

_PACKAGE = Path(__file__).parent


@dataclass(frozen=True)
class Configuration:
    """A config.yaml; names of its own files are absolute."""

    document: Document

    @property
    def root(self) -> Path:
        """The folder that the blades' files are seen from."""
        return study_folder(Path(str(self.document.content["blades_file"])))

    def changed_by(self, files: Iterable[Path | str]) -> Self:
        """Configuration with files of changes on top, each on those before it. Raises ConfigError."""
        return replace(self, document=together(self.document, [configuration_file(Path.cwd(), str(file)) for file in files]))

    @property
    def checked(self) -> Config:
        """The content as a model. Raises ConfigError."""
        return self.document.check(CONFIG)

    def changed_file(self, key: str, file: Path | str | None) -> Self:
        """Configuration with another file, if any, under `blades_file` or `scenes_file`. Raises ConfigError."""
        if file is None:
            return self
        path = existing_file("file", file, "a file that is there").absolute()
        return replace(self, document=self.document.overlaid(command_line_document({key: str(path)}, f"{key[:-5]} file")))


def read_configuration(file: Path | str | None = None) -> Configuration:
    """The configuration of a config.yaml, or without it the shipped one.

    A file that leaves out what is required lies on that of its study, as in the workflow. Raises ConfigError for a file that
    cannot be read, or that has no keys.
    """
    path = _PACKAGE / CONFIG_FILE
    if file is not None:
        path = existing_file("config", file, "a config.yaml, or none for the shipped one").absolute()
    document, study = configuration_file(path.parent, str(path)), study_folder(path) / CONFIG_FILE
    fields = Config.model_fields
    if study != path and any(field.is_required() and key not in document.content for key, field in fields.items()):
        return read_configuration(study if study.is_file() else None).changed_by([path])
    files = {key: named_file(fields[key].default, path) for key in CONFIG_FILES}
    return Configuration(replace(document, content={**files, **document.content}))


def existing_file(argument: str, file: Any, allowed: str) -> Path:
    """The file that an argument of a call names. Raises ConfigError where it is none, whatever was handed over."""
    if not isinstance(file, str | os.PathLike):
        raise ConfigError(f"{argument}: found {single_line(repr(file))}; allowed: {allowed}")
    if not os.path.isfile(file):
        raise ConfigError(f"{argument}: found {single_line(str(file))}, and there is no such file; allowed: {allowed}")
    return Path(file)
