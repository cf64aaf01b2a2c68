"""What clients ask the job server for, read without waiting for any of them."""

from __future__ import annotations

import os
import socket
import time
from dataclasses import dataclass, field
from typing import NamedTuple

PATIENCE_S = 5.0
"""With a client that has come and does not say all that it wants."""

_HEAD = 8
"""Bytes at the start of a message, which say how long the rest is."""

_LONGEST = 2**24
"""Bytes of a message: more than a system lets a process have as arguments and environment."""

_PART = 2**18


class Job(NamedTuple):
    """What a client asks for: its folder, its environment, script and arguments, and the files that its output goes to."""

    folder: str
    environment: dict[str, str]
    arguments: list[str]
    outputs: list[int]


@dataclass
class Client:
    """A client that has come: what it has said so far, the files that it has handed over, and until when it is waited for."""

    connection: socket.socket
    until: float = field(default_factory=lambda: time.monotonic() + PATIENCE_S)
    _said: bytearray = field(default_factory=bytearray)
    _outputs: list[int] = field(default_factory=list)

    def read(self) -> Job | None:
        """Take what is there; the job once all is said.

        Raises ValueError for what no client of ours says, and OSError where the connection is broken.
        """
        part, outputs, _, _ = socket.recv_fds(self.connection, _PART, 2)
        self._said += part
        self._outputs += outputs
        size = int.from_bytes(self._said[:_HEAD], "little")
        missing = _HEAD + size - len(self._said)
        if not part or size > _LONGEST or len(self._outputs) > 2:
            raise ValueError("no message of a job")
        if len(self._said) < _HEAD or missing > 0:
            return None
        folder, number, *rest = [os.fsdecode(text) for text in bytes(self._said[_HEAD:]).split(b"\0")]
        entries, arguments = rest[: int(number)], rest[int(number) :]
        if missing or not arguments or len(self._outputs) != 2:
            raise ValueError("no message of a job")
        return Job(folder, dict(entry.split("=", 1) for entry in entries), arguments, self._outputs)

    def is_late(self) -> bool:
        """Whether it has had all the time that it gets."""
        return time.monotonic() > self.until

    def close(self) -> None:
        """Be done with the client, who sees it from the end of its connection."""
        self.connection.close()
        while self._outputs:
            os.close(self._outputs.pop())
