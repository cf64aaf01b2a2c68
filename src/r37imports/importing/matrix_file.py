"""One matrix of another program: a file of Matrix Market, or .npz of SciPy or with one array; what cannot be one is refused."""

import math
import zipfile
from pathlib import Path

import numpy as np
import scipy.io
import scipy.sparse as sp

from r37imports.refusal import ImportRefused

_SYMMETRIC = 1e-8
_SHORTEST = {"coordinate": 6, "array": 2}
"""Bytes that an entry of a Matrix Market file has at least: `1 1 1` and a line's end, `1` and one."""

_MOST_NUMBERS = 2**27
"""Largest number of entries of one array: a gigabyte."""


def read_matrix(file: Path) -> sp.csr_array:
    """The matrix of a .mtx or .npz file, symmetric to the last bit.

    Raises ImportRefused for a file that is damaged, and for a matrix that is not real, square, finite and symmetric.
    """
    try:
        matrix = _market(file) if file.suffix == ".mtx" else _archive(file)
    except ImportRefused as error:
        raise ImportRefused(f"{file.name}: {error}") from None
    except Exception as error:
        raise ImportRefused(f"{file.name}: cannot be read as a matrix of Matrix Market or SciPy ({error})") from None
    largest = abs(matrix).max() if matrix.nnz else 0.0
    if not 0.0 < largest < np.inf:
        raise ImportRefused(f"{file.name}: found a matrix of which all entries are 0, or some are no numbers; write it again")
    if not abs(matrix - matrix.T).max() <= _SYMMETRIC * largest:
        raise ImportRefused(
            f"{file.name}: found a matrix that is not symmetric; allowed: both triangles, or one with `symmetric` in the header"
        )
    return 0.5 * (matrix + matrix.T)


def _market(file: Path) -> sp.csr_array:
    rows, columns, entries, layout, field, symmetry = scipy.io.mminfo(file)
    _check_shape((rows, columns), entries, field)
    stored = entries if layout == "coordinate" or symmetry == "general" else rows * (rows + 1) // 2
    # the reader takes the header's word for the memory it needs
    if _SHORTEST[layout] * stored > file.stat().st_size:
        raise ImportRefused(f"its header says {stored} entries, for which the file is too short; write it again")
    return sp.csr_array(scipy.io.mmread(file))


def _archive(file: Path) -> sp.csr_array:
    headers = _headers(file)
    for name, (shape, kind) in headers.items():
        if kind.hasobject:
            raise ImportRefused(f"found objects of Python in its array {name}; allowed: numbers")
        if math.prod(shape) > _MOST_NUMBERS:
            raise ImportRefused(f"found an array of shape {shape}; allowed: at most {_MOST_NUMBERS:,} numbers")
    if "format" in headers:
        matrix = sp.load_npz(file)
        _check_shape(matrix.shape, matrix.nnz, matrix.dtype.name)
        if hasattr(matrix, "check_format"):
            # indices out of range would end the process, not the call
            matrix.check_format(full_check=True)
        return sp.csr_array(matrix)
    if len(headers) != 1:
        raise ImportRefused(f"found {len(headers)} arrays ({', '.join(headers)}); allowed: one, or a sparse matrix of SciPy")
    ((name, (shape, kind)),) = headers.items()
    _check_shape(shape, math.prod(shape), kind.name)
    with np.load(file) as stored:
        return sp.csr_array(stored[name])


def _headers(file: Path) -> dict[str, tuple[tuple[int, ...], np.dtype]]:
    """Shape and kind of each array, before any is unpacked: a few bytes may be packed that no memory holds."""
    headers = {}
    with zipfile.ZipFile(file) as archive:
        for member in archive.namelist():
            with archive.open(member) as stream:
                version = np.lib.format.read_magic(stream)
                read = np.lib.format.read_array_header_1_0 if version == (1, 0) else np.lib.format.read_array_header_2_0
                shape, _, kind = read(stream)
            headers[member.removesuffix(".npy")] = shape, kind
    return headers


def _check_shape(shape: tuple[int, ...], entries: int, numbers: str) -> None:
    """Refuse what cannot be a mass or stiffness before anything of its size is made; `numbers`: the kind of the entries."""
    if len(shape) != 2 or shape[0] != shape[1]:
        raise ImportRefused(f"found an array of shape {shape}; allowed: a square matrix")
    if not numbers.startswith(("real", "integer", "unsigned-integer", "float", "int", "uint")):
        raise ImportRefused(f"found entries of kind {numbers}; allowed: real numbers")
    if entries < shape[0]:
        raise ImportRefused(f"found {shape[0]} rows and only {entries} entries; allowed: no empty rows")
