"""Snakemake's executor `warm`, by the name under which Snakemake looks for it: see r37core.console.executor."""

import os
import sys
from contextlib import suppress

from r37core.console.executor import Executor, common_settings
from r37core.machine_code.kept import users_cache

_cache = users_cache().parent
with suppress(OSError):
    _cache.mkdir(parents=True, exist_ok=True)
# at every start of Snakemake, which would end with a traceback
if sys.platform == "linux" and not os.access(_cache, os.W_OK):
    sys.exit(f"XDG_CACHE_HOME: found the cache folder {_cache}, which Snakemake cannot write; allowed: a folder that it can")

# where the home cannot be written
os.environ.setdefault("XDG_CACHE_HOME", str(_cache))

__all__ = ["Executor", "common_settings"]
