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
        if missing or len(self._outputs) != 2:
            raise ValueError("no message of a job")
        return _job_of(bytes(self._said[_HEAD:]), self._outputs)

    def pass_on(self, to: socket.socket) -> None:
        """Hand the client with all that it has said over to the process that reads it with `passed_on`."""
        socket.send_fds(to, [self._said[:1]], [self.connection.fileno(), *self._outputs])
        to.sendall(self._said[1:])

    def is_late(self) -> bool:
        """Whether it has had all the time that it gets."""
        return time.monotonic() > self.until

    def close(self) -> None:
        """Be done with the client, who sees it from the end of its connection."""
        self.connection.close()
        while self._outputs:
            os.close(self._outputs.pop())


def passed_on(source: socket.socket) -> tuple[Client, Job] | None:
    """The next client that another process passes on, and its job; None where that process has ended. Waits for it."""
    first, files, _, _ = socket.recv_fds(source, 1, 3)
    if not first:
        return None
    size = int.from_bytes(first + source.recv(_HEAD - 1, socket.MSG_WAITALL), "little")
    connection, *outputs = files
    client = Client(socket.socket(fileno=connection), _outputs=outputs)
    return client, _job_of(source.recv(size, socket.MSG_WAITALL), outputs)


def _job_of(message: bytes, outputs: list[int]) -> Job:
    """Raises ValueError for what no client of ours says."""
    folder, number, *rest = [os.fsdecode(text) for text in message.split(b"\0")]
    entries, arguments = rest[: int(number)], rest[int(number) :]
    if not arguments:
        raise ValueError("no message of a job")
    return Job(folder, dict(entry.split("=", 1) for entry in entries), arguments, outputs)
