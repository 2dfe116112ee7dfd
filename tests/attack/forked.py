"""Commands in forked processes, which have the modules already, and the processes that a command leaves behind.

The attacking process is the parent of all processes whose own parent has ended (Linux: a "child subreaper"), so that it
sees each process that outlives its command, whatever session or group it is in.
"""

import atexit
import ctypes
import importlib
import mmap
import os
import pkgutil
import signal
import struct
import sys
import tempfile
import threading
import time
import traceback
import types
import warnings
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

CHANGES = frozenset(
    {"os.rename", "os.remove", "os.mkdir", "os.rmdir", "os.link", "os.truncate", "fcntl.lockf", "fcntl.flock"}
)
"""Events of Python by which a command changes files or locks; "open" for writing is the other one."""

COMMAND = "from roughfilm.cli.main import main; main()"
"""The program of a new interpreter."""

POLL_S = 0.001
ORPHAN_S = 20.0
"""Time in which the processes of a killed command must end, s; the machine may be busy."""

SET_CHILD_SUBREAPER, SET_PARENT_DEATH_SIGNAL = 36, 1
"""Options of prctl."""


@dataclass(frozen=True, kw_only=True)
class Place:
    """The directories of a command: ``work`` is the current one, ``temporary`` is TMPDIR, ``cache`` the cache."""

    folder: Path

    @property
    def work(self) -> Path:
        return self.folder / "work"

    @property
    def temporary(self) -> Path:
        return self.folder / "tmp"

    @property
    def cache(self) -> Path:
        return self.folder / "cache"

    def make(self) -> None:
        for path in (self.temporary, self.cache):
            path.mkdir(parents=True)


@dataclass(frozen=True, kw_only=True)
class Stop:
    """When and how a command is stopped.

    Attributes
    ----------
    number : the signal; it is sent to the process of the command alone.
    after_s : time after the start, s; without ``change`` it decides.
    change : number of the change of files before which the command stops itself with SIGKILL, or, with ``delay_s``,
        after which it is stopped from outside.
    delay_s : time after the change, s.
    fresh : whether the command runs in a new interpreter, which imports its modules, and not in a forked one.
    """

    number: int = signal.SIGKILL
    after_s: float | None = None
    change: int | None = None
    delay_s: float | None = None
    fresh: bool = False


@dataclass(frozen=True, kw_only=True)
class Ended:
    """The end of a command.

    Attributes
    ----------
    code : exit code, or minus the number of the signal that ended it; None if it had to be ended after the limit.
    output, errors : what it printed.
    seconds : time from start to end, s.
    changes : number of changes of files that it began.
    stopped : whether the signal was sent before its end.
    orphans : command lines of the processes that outlived it by ``ORPHAN_S``; they are ended.
    """

    code: int | None
    output: str
    errors: str
    seconds: float
    changes: int
    stopped: bool = False
    orphans: tuple[str, ...] = field(default=())


def prepare() -> None:
    """Import the modules of all commands, and become the parent of what killed commands leave."""
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.prctl(SET_CHILD_SUBREAPER, 1, 0, 0, 0) != 0:
        raise OSError(ctypes.get_errno(), "prctl: this system hands no orphans over")
    warnings.filterwarnings("ignore", message=".*fork", category=DeprecationWarning)
    os.environ["PYTHONPATH"] = str(ROOT)
    os.environ |= {"COLUMNS": "200", "ROUGHFILM_PROGRESS": "off"}
    for name in importlib.import_module("roughfilm.cli.main").MODULES.values():
        importlib.import_module(name)
    for name in ("roughfilm.pages", "roughfilm.interface"):
        package = importlib.import_module(name)
        for module in pkgutil.iter_modules(package.__path__):
            importlib.import_module(f"{name}.{module.name}")
    for name in ("h5py", "matplotlib.figure", "numba", "scipy.fft", "scipy.optimize", "scipy.sparse.linalg"):
        importlib.import_module(name)


def run(
    words: Sequence[str], place: Place, *, limit_s: float, stop: Stop | None = None, known: frozenset[int] = frozenset()
) -> Ended:
    """Run ``roughfilm`` with these words in a forked process, stop it if asked, and wait for all its processes.

    Parameters
    ----------
    words : the arguments; the first may be a file of Python (.py) or a path, which is run in place of the command.
    place : the directories.
    limit_s : time after which a command that runs is ended, s.
    stop : when and how to stop it.
    known : children of this process that belong to no command.
    """
    shared = mmap.mmap(-1, 8)
    logs = [place.folder / name for name in ("stdout", "stderr")]
    own = stop.change if stop is not None and stop.delay_s is None else None
    start = time.monotonic()
    pid = os.fork()
    if pid == 0:
        _command(
            words, place, logs, None if stop is not None and stop.fresh else _counting(shared, own, str(place.folder))
        )
    moment = _moment(stop, start, shared)
    status, sent = None, False
    while True:
        ended, status = os.waitpid(pid, os.WNOHANG)
        if ended:
            break
        if not sent and stop is not None and moment():
            os.kill(pid, stop.number)
            sent = True
        if time.monotonic() - start > limit_s:
            os.kill(pid, signal.SIGKILL)
            os.waitpid(pid, 0)
            status = None
            break
        time.sleep(POLL_S)
    seconds = time.monotonic() - start
    code = None if status is None else os.waitstatus_to_exitcode(status)
    output, errors = (log.read_text(encoding="utf-8", errors="replace") for log in logs)
    return Ended(
        code=code,
        output=output,
        errors=errors,
        seconds=seconds,
        changes=struct.unpack("q", shared[:8])[0],
        stopped=sent or (own is not None and code == -signal.SIGKILL),
        orphans=_outlived(known),
    )


def _moment(stop: Stop | None, start: float, shared: mmap.mmap) -> Callable[[], bool]:
    """Whether it is time to stop the command from outside."""
    reached: list[float] = []

    def now() -> bool:
        if stop is None:
            return False
        if stop.change is None:
            return stop.after_s is not None and time.monotonic() - start >= stop.after_s
        if stop.delay_s is None:
            return False
        if not reached and struct.unpack("q", shared[:8])[0] >= stop.change:
            reached.append(time.monotonic())
        return bool(reached) and time.monotonic() - reached[0] >= stop.delay_s

    return now


Hook = Callable[[str, tuple[object, ...]], None]


def _command(words: Sequence[str], place: Place, logs: Sequence[Path], hook: Hook | None) -> None:
    """Run a command in a forked child as the interpreter runs it, and end the child; a new one without a hook."""
    code = 1
    try:
        os.setsid()
        ctypes.CDLL(None).prctl(SET_PARENT_DEATH_SIGNAL, signal.SIGKILL, 0, 0, 0)
        signal.signal(signal.SIGINT, signal.default_int_handler)
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        for number, path in enumerate([Path(os.devnull), *logs]):
            descriptor = os.open(path, os.O_RDONLY if number == 0 else os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
            os.dup2(descriptor, number)
            os.close(descriptor)
        os.chdir(place.work)
        os.environ |= {"TMPDIR": str(place.temporary), "ROUGHFILM_CACHE": str(place.cache)}
        tempfile.tempdir = None
        sys.modules["__main__"] = types.ModuleType("__main__")
        if "/" in words[0]:
            os.execv(words[0], words)
        if hook is None:
            program = words[:1] if words[0].endswith(".py") else ("-c", COMMAND)
            rest = words[1:] if words[0].endswith(".py") else words
            os.execv(sys.executable, [sys.executable, *program, *rest])
        sys.addaudithook(hook)
        if words[0].endswith(".py"):
            sys.argv = list(words)
            exec(compile(Path(words[0]).read_text("utf-8"), words[0], "exec"), {"__name__": "__main__"})
        else:
            from roughfilm.cli.main import main

            sys.argv = ["roughfilm", *words]
            main()
        code = 0
    except SystemExit as end:
        code = end.code if isinstance(end.code, int) else int(end.code is not None)
    except KeyboardInterrupt:
        code = 128 + signal.SIGINT
    except BaseException:
        traceback.print_exc()
    try:
        threading._shutdown()  # type: ignore[attr-defined]
        atexit._run_exitfuncs()
        sys.stdout.flush()
        sys.stderr.flush()
    finally:
        os._exit(code)


def _counting(shared: mmap.mmap, own: int | None, folder: str) -> Hook:
    """An audit hook that counts the changes of files in a folder by this process, and kills it before one of them."""
    pid = os.getpid()

    def hook(event: str, arguments: tuple[object, ...]) -> None:
        if event == "open":
            path, _, flags = arguments
            if not isinstance(flags, int) or not flags & (os.O_WRONLY | os.O_RDWR | os.O_CREAT):
                return
            if not str(path).startswith(folder) and str(path).startswith("/"):
                return
        elif event not in CHANGES:
            return
        if os.getpid() != pid:
            return
        count = struct.unpack("q", shared[:8])[0] + 1
        shared[:8] = struct.pack("q", count)
        if count == own:
            os.kill(pid, signal.SIGKILL)

    return hook


def _outlived(known: frozenset[int]) -> tuple[str, ...]:
    """Wait until no process of a command is left; end those that do not end, and return their command lines."""
    deadline = time.monotonic() + ORPHAN_S
    while left := children() - known:
        for pid in left:
            with suppress(ChildProcessError):
                os.waitpid(pid, os.WNOHANG)
        if time.monotonic() > deadline:
            lines = tuple(filter(None, map(_command_line, left)))
            for pid in left:
                with suppress(ProcessLookupError, ChildProcessError):
                    os.kill(pid, signal.SIGKILL)
                    os.waitpid(pid, 0)
            return lines
        time.sleep(0.01)
    return ()


def children() -> set[int]:
    """The processes whose parent is this one, those included that have ended."""
    found, own = set(), os.getpid()
    for entry in os.scandir("/proc"):
        if entry.name.isdigit():
            with suppress(OSError, ValueError, IndexError):
                state = Path(entry.path, "stat").read_text().rpartition(")")[2].split()
                if int(state[1]) == own:
                    found.add(int(entry.name))
    return found


def unused(names: set[str]) -> set[str]:
    """Those of some files of shared memory that no living process, such as one of another user, has mapped."""
    left = set(names)
    for entry in os.scandir("/proc") if left else ():
        with suppress(OSError):
            maps = Path(entry.path, "maps").read_text() if entry.name.isdigit() else ""
            left = {name for name in left if name not in maps}
    return left


def _command_line(pid: int) -> str:
    with suppress(OSError):
        return Path(f"/proc/{pid}/cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace")[:300]
    return ""
