"""Programs that end with the process that started them, even if that process is killed."""

import shutil
import subprocess
from functools import cache


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
