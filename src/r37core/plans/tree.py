"""Whether the package that is imported is the one beside the Snakefile."""

from __future__ import annotations

from pathlib import Path

import r37core
from r37core.config import ConfigError


def check_tree(root: Path) -> None:
    """Raise ConfigError unless r37core is imported from the folder `root` of the Snakefile, whose code is hashed."""
    imported, beside = Path(r37core.__file__).resolve().parent, (root / "src" / "r37core").resolve()
    if imported != beside:
        raise ConfigError(
            f"r37core: found the package in {imported}; allowed: the one beside the Snakefile, {beside} "
            "(make setup there, and use its .venv/bin/snakemake)"
        )
