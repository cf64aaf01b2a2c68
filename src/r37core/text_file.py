"""Text files that people write: read as UTF-8, with the line in the message where that fails."""

from __future__ import annotations

from pathlib import Path


class TextFileError(ValueError):
    """Something that a text file must not hold: `reason`, and the number of the `line`."""

    def __init__(self, line: int, reason: str):
        super().__init__(f"line {line}: {reason}")
        self.line, self.reason = line, reason


def read_text(file: Path) -> str:
    """Text of a UTF-8 file, with or without a byte order mark.

    Raises TextFileError for another encoding, and OSError as `open` does.
    """
    data = file.read_bytes()
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line, byte = data.count(b"\n", 0, error.start) + 1, data[error.start]
        raise TextFileError(line, f"found the byte 0x{byte:02x}, which is not UTF-8; save the file as UTF-8") from None
