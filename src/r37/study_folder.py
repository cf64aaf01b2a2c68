"""A folder for a study of one's own: configuration, Snakefile and profile, from which Snakemake runs the workflow."""

from __future__ import annotations

import os
import shutil
import tempfile
from pathlib import Path

from r37core.config import ConfigError

from .stages import stages

_PACKAGE = Path(__file__).parent

SNAKEFILE = (_PACKAGE / "Snakefile").resolve()
"""Path of the workflow's Snakefile, for `module r37: snakefile: SNAKEFILE` in a workflow of your own."""


@stages()
def init(folder: Path | str) -> Path:
    """Folder for a study that the workflow runs: the shipped configuration, a Snakefile and a profile.

    Args:
        folder: A new or an empty folder.

    Returns:
        The folder, absolute.

    Raises:
        ConfigError: For a folder that has content, and for one that cannot be written.

    Examples:
        >>> study = r37.init("rotor")
        >>> (study / "config/blades.yaml").is_file()
        True
    """
    if not isinstance(folder, str | os.PathLike):
        raise ConfigError(f"init: found {folder!r}; allowed: a folder that is new or empty")
    path = Path(folder).absolute()
    try:
        if path.exists() and not (path.is_dir() and not any(path.iterdir())):
            raise ConfigError(f"init: found {folder or '.'}, which is not empty; allowed: a folder that is new or empty")
        path.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=".r37-init-", dir=path.parent) as temporary:
            made = Path(temporary, path.name)
            # files that the user's own configuration keeps out of Git stay with the user
            shutil.copytree(_PACKAGE / "config", made / "config", ignore=shutil.ignore_patterns("my*.yaml", "own"))
            add_workflow(made)
            # complete or not there: onto an empty folder, too
            os.rename(made, path)
    except OSError as error:
        raise ConfigError(f"init: found {folder}, which cannot be written ({error.strerror}); allowed: one that can") from None
    return path


def add_workflow(folder: Path) -> None:
    """Write what Snakemake needs beside a configuration: Snakefile and profile, and what Git leaves out."""
    shutil.copytree(_PACKAGE / "profiles", folder / "profiles", dirs_exist_ok=True)
    shutil.copyfile(_PACKAGE / "study.smk", folder / "Snakefile")
    (folder / ".gitignore").write_text("/results/\n/logs/\n/.snakemake/\n")
