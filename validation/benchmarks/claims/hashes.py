"""The hash of what decides about an output: code, sections of the configuration, and numbers of fixed runs.

Of the code only what the claim names counts, without comments, docstrings and layout. The engine's code does not: any
rearrangement of it would make all tables old. What counts of it are the numbers of docs/fingerprint.json (numbers.py).
"""

from __future__ import annotations

import hashlib
import json
from functools import cache
from pathlib import Path
from typing import Any

from r37core.io import read_json
from r37core.plans.code import CodeHashes, fingerprint
from r37core.yaml_file import load_yaml

from .claim import Claim, Output

NUMBERS = "docs/fingerprint.json"
_DIGITS = 6


def present_hash(claim: Claim, output: Output, root: Path) -> str:
    """Eight digits; raises KeyError for a section or number that is not there, OSError for a file."""
    digest = hashlib.sha256()
    for file in code_files(claim, output, root):
        digest.update(str(file.relative_to(root)).encode() + fingerprint(file))
    for section in claim.configuration:
        digest.update(section.encode() + _section(root, section))
    known = read_json(root / NUMBERS) if claim.numbers else {}
    for name in claim.numbers:
        digest.update(name.encode() + json.dumps(_rounded(known[name])).encode())
    return digest.hexdigest()[:8]


def code_files(claim: Claim, output: Output, root: Path) -> list[Path]:
    """Files of code that decide about an output, with those of validation/benchmarks/ that they import."""
    named = [root / name for name in (*claim.code, *output.drawn_by)]
    folder = root / "validation/benchmarks"
    imports = CodeHashes(root / "src", folder, packages=())
    scripts = [file for file in named if file.parent == folder]
    return sorted({*named, *(file for script in scripts for file in imports.closure(script.stem))})


def _section(root: Path, section: str) -> bytes:
    """A file, or what stands in a YAML file under a key, whatever the layout."""
    name, _, key = section.partition(":")
    if not name.endswith(".yaml"):
        return (root / name).read_bytes()
    content: Any = _loaded(root / name)
    for part in key.split(".") if key else ():
        content = content[part]
    return json.dumps(content, sort_keys=True, default=str).encode()


@cache
def _loaded(file: Path) -> Any:
    return load_yaml(file)


def _rounded(values: dict[str, float]) -> dict[str, str]:
    return {name: f"{value:.{_DIGITS}g}" for name, value in values.items()}
