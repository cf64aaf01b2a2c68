"""Compiling C sources for this machine's processor and loading them. Light: the simulation jobs import it.

A library is built once for its sources, its definitions, the compiler and the processor, and kept beside the package, or
in the user's cache folder where the package cannot be written.
"""

from __future__ import annotations

import ctypes
import hashlib
import os
import platform
import shlex
import shutil
import subprocess
import tempfile
from collections.abc import Mapping
from pathlib import Path

# sums may be reordered and contracted, so that they vectorise; NaN and infinity keep their meaning
_FLAGS = "-std=gnu11 -O3 -march=native -fPIC -shared -fno-math-errno -fno-trapping-math -fno-signed-zeros -fassociative-math"


class CompilerError(RuntimeError):
    """No C compiler, or one that fails."""


_PACKAGE = Path(__file__).parent


def load_library(source: Path, definitions: Mapping[str, str | int]) -> ctypes.CDLL:
    """The shared library of a C file, compiled with `-Dname=value` for each definition if it is not there yet.

    The file may include the package's headers, as "march/flight.h". Raises CompilerError.
    """
    compiler = shlex.split(os.environ.get("CC", "cc"))
    flags = _FLAGS.split() + [f"-D{name}={value}" for name, value in sorted(definitions.items())]
    flags.append(f"-I{_PACKAGE}")
    version = hashlib.sha256(repr((compiler, flags, _processor())).encode())
    for file in [source, *sorted(_PACKAGE.glob("*/*.h"))]:
        version.update(file.read_bytes())
    name = f"{source.stem}-{version.hexdigest()[:16]}.so"
    folder = _cache(source)
    library = folder / name
    if not library.exists():
        _compile(source, [*compiler, *flags], library)
    return ctypes.CDLL(str(library))


def _processor() -> str:
    """What the compiler's -march=native depends on."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="ascii", errors="replace").splitlines()
    except OSError:
        lines = []
    features = next((line for line in lines if line.lower().startswith(("flags", "features"))), "")
    return f"{platform.machine()} {platform.processor()} {features}"


def _cache(source: Path) -> Path:
    beside = source.parent / "__pycache__"
    if _writable(beside):
        return beside
    users = Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "r37"
    users.mkdir(parents=True, exist_ok=True)
    return users


def _writable(folder: Path) -> bool:
    try:
        folder.mkdir(exist_ok=True)
    except OSError:
        return False
    return os.access(folder, os.W_OK)


def _compile(source: Path, command: list[str], library: Path) -> None:
    """Compile to a file of its own and move it into place, so that processes may do so side by side."""
    if shutil.which(command[0]) is None:
        raise CompilerError(
            f"C compiler {command[0]!r} not found: the simulations are compiled for this machine; install one "
            "(on Debian: apt-get install gcc libc6-dev) or name it in the environment variable CC"
        )
    handle, partial = tempfile.mkstemp(suffix=".so", dir=library.parent)
    os.close(handle)
    try:
        done = subprocess.run([*command, "-o", partial, str(source), "-lm"], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise CompilerError(f"{' '.join(command)} failed on {source.name}:\n{done.stderr.strip()}")
        os.replace(partial, library)
    finally:
        Path(partial).unlink(missing_ok=True)
