"""Which configuration a call is made with: the shipped one, or one's own."""

import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Self

from r37core.config import ConfigError, Document, command_line_document, read_document
from r37core.config.config_file import Config
from r37core.config.messages import single_line
from r37core.config.reading import together
from r37core.product.extensions import CONFIG

_PACKAGE = Path(__file__).parent
_FOLDER = "config"
"""Folder of the repository and of this package, where it is a link or, once installed, a copy."""


@dataclass(frozen=True)
class Configuration:
    """A config.yaml and the folder `root` that names of tables start from; names of its own files are absolute."""

    document: Document
    root: Path

    def changed_by(self, files: Iterable[Path | str]) -> Self:
        """Configuration with files of changes on top, each on those before it. Raises ConfigError."""
        return replace(self, document=together(self.document, [read_document(Path.cwd(), str(file)) for file in files]))

    @property
    def checked(self) -> Config:
        """The content as a model. Raises ConfigError."""
        return self.document.check(CONFIG)

    def changed_file(self, key: str, file: Path | str | None) -> Self:
        """Configuration with another file, if any, under `blades_file` or `scenes_file`; tables of blades lie next to it.

        Raises ConfigError.
        """
        if file is None:
            return self
        path = existing_file("file", file, "a file that is there").absolute()
        document = self.document.overlaid(command_line_document({key: str(path)}, f"{key[:-5]} file"))
        return replace(self, document=document, root=_root_of(path) if key == "blades_file" else self.root)


def read_configuration(file: Path | str | None = None) -> Configuration:
    """The configuration of a config.yaml, or without it the shipped one.

    Names of files in it start from its folder or, where that is called config, as in the repository, from the one above. Raises
    ConfigError for a file that cannot be read, or that has no keys.
    """
    path = _PACKAGE / _FOLDER / "config.yaml"
    if file is not None:
        path = existing_file("config", file, "a config.yaml, or none for the shipped one").absolute()
    document, root = read_document(path.parent, str(path)), _root_of(path)
    if not isinstance(document.content, Mapping):
        raise document.refusal((), repr(document.content)[:60], "keys and values, as in config/config.yaml")
    fields = Config.model_fields
    files = {key: document.content.get(key, fields[key].default) for key in ("blades_file", "fidelity_file", "scenes_file")}
    absolute = {key: str(root / name) if isinstance(name, str) and name else name for key, name in files.items()}
    return Configuration(replace(document, content={**document.content, **absolute}), root)


def existing_file(argument: str, file: Any, allowed: str) -> Path:
    """The file that an argument of a call names. Raises ConfigError where it is none, whatever was handed over."""
    if not isinstance(file, str | os.PathLike):
        raise ConfigError(f"{argument}: found {single_line(repr(file))}; allowed: {allowed}")
    if not os.path.isfile(file):
        raise ConfigError(f"{argument}: found {single_line(str(file))}, and there is no such file; allowed: {allowed}")
    return Path(file)


def _root_of(file: Path) -> Path:
    """The folder that names in a file start from."""
    return file.parent.parent if file.parent.name == _FOLDER else file.parent
