"""Sparse direct solution and the lowest modes of the clamped blade."""

import mmap
import resource
from collections.abc import Callable

import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as sla
from numpy import ndarray

Solve = Callable[[ndarray], ndarray]
"""Displacements, shape (dofs,) or (dofs, loads), under forces of that shape."""

_TOLERANCE = 1e-12
"""Relative tolerance of eigenvalues; the rounding of the factors changes them by more."""


_ROOM_BYTES = 400
"""Address space for each non-zero entry. Factors fill 50 to 190; SuperLU may enlarge them by ever less with less room."""


def factorise(matrix: sp.sparray) -> Solve:
    """Factorise a symmetric or Hermitian positive definite matrix; the returned function solves for one or more right sides.

    SuperLU in symmetric mode with minimum-degree ordering of A^T + A. On this project's meshes (thin, almost
    two-dimensional) it is within a factor of two of CHOLMOD, without its licence and platform limits. MemoryError without room.
    """
    if resource.getrlimit(resource.RLIMIT_AS)[0] != resource.RLIM_INFINITY:
        _check_room(matrix)
    factors = sla.splu(sp.csc_array(matrix), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    return factors.solve


def _check_room(matrix: sp.sparray) -> None:
    """MemoryError where this process has no address space left for the factors."""
    room = _ROOM_BYTES * matrix.nnz
    try:
        mmap.mmap(-1, room, flags=mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS).close()
    except OSError:
        wanted = f"the factors of {matrix.shape[0]} degrees of freedom need room for {room / 1e6:.0f} MB"
        raise MemoryError(f"{wanted}; raise the limit of this process (ulimit -v)") from None


def lowest_modes(stiffness: sp.sparray, mass: sp.sparray, count: int, solve: Solve | None = None) -> tuple[ndarray, ndarray]:
    """The `count` lowest eigenvalues (rad2/s2), ascending, and mass-normalised modes, shape (dofs, count).

    Shift-invert Lanczos about zero with a fixed start vector, so the result is reproducible; `solve` is the
    factorised stiffness if the caller already has it.
    """
    size = stiffness.shape[0]
    if count == 0:
        return np.empty(0), np.empty((size, 0))
    inverse = sla.LinearOperator((size, size), matvec=solve or factorise(stiffness), dtype=stiffness.dtype)
    start = np.random.default_rng(37).standard_normal(size)
    eigenvalues, modes = sla.eigsh(stiffness, count, M=mass, sigma=0.0, OPinv=inverse, v0=start, tol=_TOLERANCE)
    order = np.argsort(eigenvalues)
    eigenvalues, modes = eigenvalues[order], modes[:, order]
    largest = np.abs(modes).argmax(axis=0)
    tops = modes[largest, np.arange(count)]
    return eigenvalues, modes * np.conj(tops / np.abs(tops))
