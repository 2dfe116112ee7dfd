"""Programs that end with the process that started them, even if that is killed."""

import shutil
import subprocess
from functools import cache


@cache
def terminate_with_parent() -> tuple[str, ...]:
    """What stands before a command so that Linux ends it when the thread that started it ends; nothing elsewhere.

    That thread waits for it, so it ends first only if this process is killed. (Python's own ``preexec_fn`` is not safe
    beside threads.)
    """
    command = ("setpriv", "--pdeathsig", "TERM")
    if shutil.which(command[0]) is None:
        return ()
    tried = subprocess.run([*command, "true"], stdin=subprocess.DEVNULL, capture_output=True, check=False)
    return command if tried.returncode == 0 else ()
