"""Run a script's job in the job server of this Snakemake (r37core.console.job_server), or by itself where none answers.

Started as `python -S -E start.py SCRIPT ARGUMENTS`, with as few imports as there can be: it starts once for every job.
"""

import _socket  # what `socket` is made of: a hundredth of a second less
import os
import sys


def ask(address, arguments):
    """Exit status of the job; None if there is no server, or it did not end the job."""
    message = b"\0".join(map(os.fsencode, arguments))
    server = _socket.socket(_socket.AF_UNIX, _socket.SOCK_STREAM)
    try:
        server.connect(address)
        output = (1).to_bytes(4, sys.byteorder) + (2).to_bytes(4, sys.byteorder)
        server.sendall(len(message).to_bytes(8, "little"))
        # the first byte brings the job our output
        server.sendmsg([message[:1]], [(_socket.SOL_SOCKET, _socket.SCM_RIGHTS, output)])
        server.sendall(message[1:])
        answer = server.recv(1)
    except OSError:
        return None
    return answer[0] if answer else None


address, arguments = os.environ.get("R37_JOB_SERVER"), sys.argv[1:]
status = None
if address:
    # steps have a process of their own; Snakemake's copies of step.py are called .../tmp1234.step.py
    address += "_steps" * arguments[0].endswith(".step.py")
    environment = [f"{name}={value}" for name, value in os.environ.items()]
    status = ask(address, [os.getcwd(), str(len(environment)), *environment, *arguments])
if status is None:
    os.execv(sys.executable, [sys.executable, *sys.argv[1:]])
# nothing is left to clean up
os._exit(status)
