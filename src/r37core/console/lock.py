"""Whose run holds Snakemake's lock, so that the lock of a killed run can be lifted.

Every run leaves a record of its process *before* Snakemake takes its lock, and removes it at its end. So a lock is a killed
run's where there are records and none is of a process that lives, at whatever moment the run was killed.
"""

import atexit
import os
import shutil
import socket
from pathlib import Path

_LOCKS = Path(".snakemake/locks")
_RECORDS = Path(".snakemake/r37_running")


def enter() -> list[str]:
    """Say that this process runs here, and remove the lock of a killed one; what was done, in words.

    Call it before Snakemake takes its lock. Two runs that begin at once do not lift each other's lock, since each says that
    it is there before it looks.
    """
    mine = _RECORDS / _identity(os.getpid())
    _RECORDS.mkdir(parents=True, exist_ok=True)
    mine.touch()
    atexit.register(mine.absolute().unlink, missing_ok=True)
    return _lift_stale([file for file in _RECORDS.iterdir() if file != mine])


def release() -> None:
    """Say that this process is done."""
    (_RECORDS / _identity(os.getpid())).unlink(missing_ok=True)


def _lift_stale(others: list[Path]) -> list[str]:
    if not others or any(_may_live(file.name) for file in others):
        return []
    locked = _LOCKS.is_dir() and any(_LOCKS.iterdir())
    if locked:
        shutil.rmtree(_LOCKS)
    for file in others:
        file.unlink(missing_ok=True)
    killed = ", ".join(file.name.split("_")[0] for file in others)
    message = f"the last run here was killed (process {killed}); its lock is lifted, and what it left half-done runs again"
    return [message] if locked else []


def _may_live(record: str) -> bool:
    """True where the process of a record is alive, or cannot be asked."""
    pid, _, host = (*record.split("_", 2), "", "")[:3]
    return not pid.isdecimal() or host != socket.gethostname() or record == _identity(int(pid))


def _identity(pid: int) -> str:
    """A process as nobody else can be it: number, when it began, machine."""
    try:
        began = Path(f"/proc/{pid}/stat").read_text(encoding="ascii", errors="replace").rsplit(")", 1)[1].split()[19]
    except (OSError, IndexError):
        began = "running" if _alive(pid) else "gone"
    return f"{pid}_{began}_{socket.gethostname()}"


def _alive(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except OSError as error:
        return isinstance(error, PermissionError)
    return True
