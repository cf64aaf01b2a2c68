"""The folder of a call of many runs: a configuration that says all of it, from which Snakemake runs the workflow."""

import os
import shutil
import tempfile
from collections.abc import Mapping
from itertools import count
from pathlib import Path
from typing import Any

from r37core.base.io import write_text
from r37core.base.yaml_file import yaml_text
from r37core.config import ConfigError
from r37core.config.named_files import TABLES, file_keys
from r37core.config.reading import entry_document
from r37core.config.section import Without

from .call_settings import Call, above
from .study_folder import add_workflow

_CONFIG = "config/config.yaml"

_HEADER = "# Written by a call of r37; `snakemake tables --cores 2` in this folder runs the same.\n"


def run_folder(folder: Any) -> Path:
    """The folder of a call, absolute: new, empty, or of an earlier call. Raises ConfigError for others."""
    if not isinstance(folder, str | os.PathLike):
        raise ConfigError(f"folder: found {folder!r}; allowed: a folder that is new, empty, or of an earlier call")
    path = Path(folder).absolute()
    try:
        path.mkdir(parents=True, exist_ok=True)
        config = path / _CONFIG
        if any(path.iterdir()) and not (config.is_file() and config.read_text(encoding="utf-8").startswith(_HEADER)):
            raise ConfigError(f"folder: found {folder}, which has something else in it; allowed: a new or empty folder")
        tempfile.TemporaryFile(dir=path).close()
    except OSError as error:
        refusal = f"folder: found {folder}, which cannot be written ({error.strerror})"
        raise ConfigError(f"{refusal}; allowed: one that can") from None
    return path


def write_run(call: Call, folder: Path) -> None:
    """Write all that a call asks for as the files of a study; files that have not changed stay as they are."""
    settings, root = call.settings, call.settings.root
    config = dict(settings.document.content)
    blades, _ = entry_document("blade", root, settings.config.blades_file, above(call.blades))
    tables: dict[str, Path] = {}
    files = {
        "blades": {name: _local_entry(entry, root, tables) for name, entry in blades.content.items()},
        "scenes": settings.scene_designs.document.content,
        "fidelity": settings.levels_document.content,
    }
    # first, so that a call that was killed here knows its folder again
    _write(config | {f"{kind}_file": f"config/{kind}.yaml" for kind in files}, folder / _CONFIG)
    for kind, content in files.items():
        _write(content, folder / f"config/{kind}.yaml")
    for name, source in tables.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, folder / name)
    if not (folder / "Snakefile").exists():
        add_workflow(folder)


def _local_entry(entry: Mapping[str, Any], root: Path, tables: dict[str, Path]) -> dict[str, Any]:
    """An entry of blades.yaml whose files are found from the folder of the run; `tables` gets those that are copied there."""
    changed = dict(entry)
    for key in file_keys(entry):
        name, source = Path(entry[key]), (root / entry[key]).absolute()
        if key not in TABLES or not source.is_file():
            changed[key] = str(source)
        else:
            if name.is_absolute() or ".." in name.parts:
                names = (Path(f"config/tables/{'_' * more}{source.name}") for more in count())
                name = next(name for name in names if tables.get(str(name), source) == source)
            changed[key] = str(name)
            tables[str(name)] = source
    return changed


def _write(content: Mapping[str, Any], file: Path) -> None:
    def plain(value: Any) -> Any:
        if isinstance(value, Mapping):
            return {key: plain(inner) for key, inner in value.items() if inner is not Without.KEY}
        return [plain(inner) for inner in value] if isinstance(value, list | tuple) else value

    text = _HEADER + yaml_text(plain(content))
    if not file.exists() or file.read_text(encoding="utf-8") != text:
        write_text(text, file)
