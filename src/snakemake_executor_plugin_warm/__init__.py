"""Snakemake's executor `warm`, by the name under which Snakemake looks for it: see r37core.console.executor."""

import os
import sys

from r37core.console.executor import Executor, common_settings
from r37core.machine_code.kept import users_cache

# imported at every start of Snakemake, which would end with a traceback
if sys.platform == "linux":
    folder = users_cache().parent
    try:
        folder.mkdir(parents=True, exist_ok=True)
        writable = os.access(folder, os.W_OK)
    except OSError:
        writable = False
    if not writable:
        sys.exit(
            f"XDG_CACHE_HOME: found the cache folder {folder}, which Snakemake cannot write; allowed: a folder that it can"
        )

__all__ = ["Executor", "common_settings"]
