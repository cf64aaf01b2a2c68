"""Arrays and records that vectors of numbers can be loaded from."""

from collections.abc import Sequence

import numpy as np

LANES, NUMBER_BYTES = 8, 8
"""Numbers that the compiled time integration handles at once (r37core.machine_code.lanes), and bytes of each."""

_VECTOR_BYTES = NUMBER_BYTES * LANES

Field = tuple[str, object, tuple[int, ...]]
"""Name, dtype and shape of a field of a record."""


def padded(count: int) -> int:
    """`count` rounded up to whole vectors."""
    return -(-count // LANES) * LANES


def aligned_record(*groups: Sequence[Field]) -> np.dtype:
    """A record of groups of fields, whose arrays start on a vector's boundary; plain numbers are packed."""
    fields = [field for group in groups for field in group]
    offsets, end = [], 0
    for _, kind, shape in fields:
        if shape or np.dtype(kind).names:  # type: ignore[call-overload]
            end = -(-end // _VECTOR_BYTES) * _VECTOR_BYTES
        offsets.append(end)
        end += np.dtype((kind, shape)).itemsize  # type: ignore[call-overload]
    names = [name for name, _, _ in fields]
    formats = [(kind, shape) for _, kind, shape in fields]
    size = -(-end // _VECTOR_BYTES) * _VECTOR_BYTES
    return np.dtype({"names": names, "formats": formats, "offsets": offsets, "itemsize": size})  # type: ignore[call-overload]


def aligned_zeros(shape: tuple[int, ...], kind: np.dtype | type = np.float64) -> np.ndarray:
    """Zeros that start on a vector's boundary."""
    kind = np.dtype(kind)
    size = int(np.prod(shape)) * kind.itemsize
    buffer = np.zeros(size + _VECTOR_BYTES, dtype=np.uint8)
    start = -buffer.ctypes.data % _VECTOR_BYTES
    return buffer[start : start + size].view(kind).reshape(shape)


def address_of(array: np.ndarray, boundary: int = _VECTOR_BYTES) -> int:
    """Address of an array that a program loads vectors from, or plain numbers if its `boundary` is NUMBER_BYTES.

    Raises ValueError if it begins elsewhere, or has gaps: the program would end the process without a message.
    """
    if array.ctypes.data % boundary or not array.flags.c_contiguous:
        raise ValueError(f"an array at {array.ctypes.data:#x}; needed: without gaps, from a multiple of {boundary} bytes on")
    return array.ctypes.data
