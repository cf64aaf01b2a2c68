"""One matrix of another program: a file of Matrix Market; what cannot be one is refused."""

from pathlib import Path

import scipy.io
import scipy.sparse as sp

from r37imports.refusal import ImportRefused

_SYMMETRIC = 1e-8
_SHORTEST = {"coordinate": 6, "array": 2}
"""Bytes that an entry has at least: `1 1 1` and a line's end, `1` and one."""


def read_matrix(file: Path) -> sp.csr_array:
    """The matrix of a .mtx file, symmetric to the last bit.

    Raises ImportRefused for a file that is damaged, and for a matrix that is not real, square, finite and symmetric.
    """
    try:
        matrix = _market(file)
    except ImportRefused as error:
        raise ImportRefused(f"{file.name}: {error}") from None
    except Exception as error:
        raise ImportRefused(f"{file.name}: cannot be read as a matrix of Matrix Market ({error})") from None
    largest = abs(matrix).max() if matrix.nnz else 0.0
    if not 0.0 < largest < float("inf"):
        raise ImportRefused(f"{file.name}: found a matrix of which all entries are 0, or some are no numbers; write it again")
    if not abs(matrix - matrix.T).max() <= _SYMMETRIC * largest:
        raise ImportRefused(
            f"{file.name}: found a matrix that is not symmetric; allowed: both triangles, or one with `symmetric` in the header"
        )
    return 0.5 * (matrix + matrix.T)


def _market(file: Path) -> sp.csr_array:
    """The matrix, after a look at its header: the reader takes that at its word for the memory it needs."""
    rows, columns, entries, layout, field, symmetry = scipy.io.mminfo(file)
    if rows != columns:
        raise ImportRefused(f"found an array of shape {(rows, columns)}; allowed: a square matrix")
    if field not in ("real", "integer", "unsigned-integer"):
        raise ImportRefused(f"found entries of kind {field}; allowed: real numbers")
    if entries < rows:
        raise ImportRefused(f"found {rows} rows and only {entries} entries; allowed: no empty rows")
    stored = entries if layout == "coordinate" or symmetry == "general" else rows * (rows + 1) // 2
    if _SHORTEST[layout] * stored > file.stat().st_size:
        raise ImportRefused(f"its header says {stored} entries, for which the file is too short; write it again")
    return sp.csr_array(scipy.io.mmread(file))
