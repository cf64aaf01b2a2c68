"""The registry of the studies: a capability is one folder of this package, one file of rules, and one line here."""

FOLDERS = (
    "exports",
    "shapes",
    "signals",
    "run_ups",
    "second_motions",
    "rotors",
    "designs",
    "requirements",
    "tolerances",
    "search",
    "measured",
    "trials",
)
"""Folders of the extensions, in the order of their sections in docs/configuration.md."""

EXTENSIONS = {folder: f"r37studies.{folder}.plan" for folder in FOLDERS}
"""Module of each with its declaration (r37core.plans.extension)."""

RULES = {folder: f"studies/{folder}.smk" for folder in FOLDERS}
"""File of each in workflow/rules."""
