"""Programs that end with the process that started them, even if that process is killed."""

import os
import shutil
import signal
import subprocess
from contextlib import suppress
from functools import cache
from pathlib import Path


@cache
def terminate_with_parent() -> tuple[str, ...]:
    """The words before a command that make Linux terminate it with the thread that started it.

    The result is empty where the program ``setpriv`` is missing or does not work.

    The thread waits for its child, so it ends before the child only if this process is killed. Python's ``preexec_fn``
    is no alternative: it is unsafe in a program with threads.
    """
    command = ("setpriv", "--pdeathsig", "TERM")
    if shutil.which(command[0]) is None:
        return ()
    tried = subprocess.run([*command, "true"], stdin=subprocess.DEVNULL, capture_output=True, check=False)
    return command if tried.returncode == 0 else ()


def kill_session(leader: int) -> None:
    """Kill the process that leads a session, and all of the session, whatever their groups; last this process itself.

    A process that starts while others are killed is found by another look. Without the folder /proc only the group of
    the leader is killed.
    """
    own, killed = os.getpid(), set[int]()
    while left := _session(leader) - killed - {own}:
        for process in left:
            with suppress(ProcessLookupError):
                os.kill(process, signal.SIGKILL)
        killed |= left
    with suppress(ProcessLookupError):
        os.killpg(leader, signal.SIGKILL)


def _session(leader: int) -> set[int]:
    """The numbers of the processes of a session."""
    found = set()
    for stat in Path("/proc").glob("[0-9]*/stat"):
        with suppress(OSError):
            after_name = stat.read_text(encoding="utf-8", errors="replace").rpartition(")")[2].split()
            if int(after_name[3]) == leader:
                found.add(int(stat.parent.name))
    return found
