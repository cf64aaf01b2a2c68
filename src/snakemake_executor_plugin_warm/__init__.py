"""Snakemake's executor `warm`, by the name under which Snakemake looks for it: see r37core.console.executor."""

from r37core.console.executor import Executor, common_settings

__all__ = ["Executor", "common_settings"]
