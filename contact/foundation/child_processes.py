"""Programs that end with the process that started them, even if that is killed."""

import shutil
import subprocess
from functools import cache


@cache
def terminate_with_parent() -> tuple[str, ...]:
    """Words to put before a command so that Linux terminates it with the thread that started it; empty elsewhere.

    The thread waits for its child, so it ends before the child only if this process is killed. Python's ``preexec_fn``
    is no alternative: it is unsafe in a program with threads.
    """
    command = ("setpriv", "--pdeathsig", "TERM")
    if shutil.which(command[0]) is None:
        return ()
    tried = subprocess.run([*command, "true"], stdin=subprocess.DEVNULL, capture_output=True, check=False)
    return command if tried.returncode == 0 else ()
