"""The small complementarity problem of rigid contact."""

from __future__ import annotations

from numba import njit

_BLOCK_ROUNDS = 8
_SINGLE_ROUNDS = 500


@njit(cache=True, forceinline=True)
def solve_complementarity(matrix, gap, multipliers, work, guess):
    """Find multipliers >= 0 with gap + matrix @ multipliers >= 0 and the two never both positive.

    `guess`, shape (n,): positive where a node is expected to touch, as in the step before; without any, the closed gaps.

    `matrix`, shape (n, n); `gap`, shape (n,); the answer goes into `multipliers`, shape (n,); `work`: scratch, shape
    (n, n + 2). Block principal pivoting, then Murty's least-index rule, which ends for every P-matrix (Cottle, Pang and
    Stone, The Linear Complementarity Problem, section 4.2). Returns the largest violation of either sign condition,
    relative to the largest gap given.
    """
    n = len(gap)
    active = work[:, n + 1]
    scale = 0.0
    guessed = False
    for i in range(n):
        guessed = guessed or guess[i] > 0.0
        scale = max(scale, abs(gap[i]))
    for i in range(n):
        active[i] = 1.0 if (guess[i] > 0.0 if guessed else gap[i] < 0.0) else 0.0
    tolerance = 1e-12 * scale
    violation = 0.0
    for iteration in range(_BLOCK_ROUNDS + _SINGLE_ROUNDS):
        _solve_active(matrix, gap, multipliers, work)
        violation = 0.0
        for i in range(n):
            if active[i] > 0.0:
                bad = -multipliers[i] * matrix[i, i]
            else:
                opened = gap[i]
                for j in range(n):
                    if multipliers[j] != 0.0:
                        opened += matrix[i, j] * multipliers[j]
                bad = -opened
            if bad > tolerance:
                violation = max(violation, bad)
                active[i] = 1.0 - active[i]
                if iteration >= _BLOCK_ROUNDS:
                    break
        if violation == 0.0:
            break
    for i in range(n):
        multipliers[i] = max(multipliers[i], 0.0)
    return violation / scale if scale > 0.0 else 0.0


@njit(cache=True, forceinline=True)
def _solve_active(matrix, gap, multipliers, work):
    """Gap zero at the active nodes, multiplier zero at the others: Gaussian elimination with partial pivoting."""
    n = len(gap)
    size, last = 0, 0
    for i in range(n):
        multipliers[i] = 0.0
        if work[i, n + 1] > 0.0:
            size += 1
            last = i
    if size == 1:
        multipliers[last] = -gap[last] / matrix[last, last] if matrix[last, last] != 0.0 else 0.0
        return
    size = 0
    for i in range(n):
        if work[i, n + 1] > 0.0:
            column = 0
            for j in range(n):
                if work[j, n + 1] > 0.0:
                    work[size, column] = matrix[i, j]
                    column += 1
            work[size, n] = -gap[i]
            size += 1
    for k in range(size):
        pivot = k
        for i in range(k + 1, size):
            if abs(work[i, k]) > abs(work[pivot, k]):
                pivot = i
        if pivot != k:
            for j in range(size):
                work[k, j], work[pivot, j] = work[pivot, j], work[k, j]
            work[k, n], work[pivot, n] = work[pivot, n], work[k, n]
        if work[k, k] == 0.0:
            continue
        for i in range(k + 1, size):
            factor = work[i, k] / work[k, k]
            for j in range(k, size):
                work[i, j] -= factor * work[k, j]
            work[i, n] -= factor * work[k, n]
    for k in range(size - 1, -1, -1):
        for j in range(k + 1, size):
            work[k, n] -= work[k, j] * work[j, n]
        work[k, n] = work[k, n] / work[k, k] if work[k, k] != 0.0 else 0.0
    row = 0
    for i in range(n):
        if work[i, n + 1] > 0.0:
            multipliers[i] = work[row, n]
            row += 1
