"""Whose run holds Snakemake's lock, so that the lock of a killed run can be lifted."""

from __future__ import annotations

import json
import os
import shutil
import socket
from pathlib import Path
from typing import Any

_LOCKS = Path(".snakemake/locks")
_HOLDER = Path(".snakemake/r37_running.json")


def claim() -> None:
    """Say that this process runs here; call it once Snakemake has its lock."""
    _HOLDER.write_text(json.dumps(_identity(os.getpid())), encoding="utf-8")


def release() -> None:
    """Say that this process is done, if it has claimed the lock."""
    if _holder() == _identity(os.getpid()):
        _HOLDER.unlink()


def lift_stale() -> list[str]:
    """Remove the lock that a killed process of this machine left behind; what was done, in words."""
    holder = _holder()
    if not (holder and _LOCKS.is_dir() and any(_LOCKS.iterdir())):
        return []
    if holder.get("host") != socket.gethostname() or holder == _identity(holder["pid"]):
        return []
    shutil.rmtree(_LOCKS)
    _HOLDER.unlink()
    return [
        f"the last run here was killed (process {holder['pid']}); its lock is lifted, and what it left half-done runs again"
    ]


def _holder() -> dict[str, Any]:
    """What the file says; nothing where it is not there, or not as `claim` writes it."""
    try:
        found = json.loads(_HOLDER.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return found if isinstance(found, dict) and isinstance(found.get("pid"), int) else {}


def _identity(pid: Any) -> dict[str, str | int]:
    """A process as nobody else can be it: number, when it began, machine."""
    try:
        began = Path(f"/proc/{pid}/stat").read_text(encoding="ascii", errors="replace").rsplit(")", 1)[1].split()[19]
    except (OSError, IndexError):
        began = "running" if _alive(pid) else "gone"
    return {"pid": pid, "began": began, "host": socket.gethostname()}


def _alive(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    except PermissionError:
        return True
    return True
