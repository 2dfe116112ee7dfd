"""An executor of ``concurrent.futures`` that runs jobs in processes of this machine."""

import multiprocessing
import os
import signal
import sys
import tempfile
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import BrokenExecutor, Future, ThreadPoolExecutor
from contextlib import AbstractContextManager, ExitStack, contextmanager, nullcontext, suppress
from functools import cache, partial
from multiprocessing import forkserver
from multiprocessing.connection import Connection
from multiprocessing.context import ForkServerProcess
from multiprocessing.util import Finalize, get_temp_dir
from pathlib import Path
from types import ModuleType
from typing import Any, Self

from roughfilm.contact.foundation.child_processes import kill_session
from roughfilm.contact.foundation.writing.scratch import scratch_directory, temporary_directory

THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
"""Environment variables that are set to 1 unless they are set, because the jobs share the cores."""


MAX_SOCKET_PLACE = 40
"""Length of the path of a temporary directory above which sockets are in /tmp; Linux allows them 107 bytes."""


MOST_PROCESSES = 1024
"""Largest number of processes that is accepted."""

_STARTING = threading.Lock()
"""Held while a process starts."""


class Processes(ThreadPoolExecutor):
    """An executor with one process for each thread; if a process dies, only its current call is lost.

    A ``ProcessPoolExecutor`` would then fail every pending call, and would wait forever if the process died while it
    sent an answer. The processes end with the current process or at the shutdown. The caller removes the files that
    they leave in ``scratch``.
    """

    def __init__(self, count: int, scratch: Path) -> None:
        super().__init__(count)
        self._context = multiprocessing.get_context("forkserver")
        self._context.set_forkserver_preload(["roughfilm.batch.execute", *_imported_models()])
        _place_socket()
        handler = signal.signal(signal.SIGINT, signal.SIG_IGN)  # children inherit this and ignore Ctrl-C
        forkserver.ensure_running()
        signal.signal(signal.SIGINT, handler)
        self._scratch = scratch
        self._alive, self._writer = self._context.Pipe(duplex=False)
        self._own = threading.local()
        self._started: list[ForkServerProcess] = []

    def submit(self, call: Callable[..., Any], /, *arguments: Any, **options: Any) -> Future[Any]:
        """Call a function in one of the processes; the future raises BrokenExecutor if the process dies."""
        return super().submit(self._in_process, partial(call, *arguments, **options))

    def executor(self, needs: str | None = None) -> Self:  # noqa: ARG002 (all processes are of this machine)
        """These processes."""
        return self

    def watch(self) -> None:
        """Do nothing, because a process that dies is replaced."""

    def _in_process(self, call: Callable[[], Any]) -> Any:
        if not hasattr(self._own, "pipe"):
            self._start()
        try:
            self._own.pipe.send(call)
            value, error = self._own.pipe.recv()
        except (EOFError, OSError):
            _kill(self._own.process)
            del self._own.pipe
            raise BrokenExecutor("the process died") from None
        if error is not None:
            raise error
        return value

    def _start(self) -> None:
        pipe, far_end = self._context.Pipe()
        process = self._context.Process(target=_work, args=(far_end, self._alive, self._scratch), daemon=True)
        with _without_program():
            process.start()
        far_end.close()  # otherwise the pipe would stay open after the end of the process
        self._own.pipe, self._own.process = pipe, process
        self._started.append(process)

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = True) -> None:
        """End the processes immediately; calls that are not finished are lost."""
        super().shutdown(wait=False, cancel_futures=cancel_futures)
        self._writer.close()
        for process in self._started:
            if process.is_alive():
                _kill(process)
            process.join()
        super().shutdown(wait=wait)


def _imported_models() -> list[str]:
    """The modules of models that this process has imported, which all workers then share."""
    return [name for name in sys.modules if name.startswith("roughfilm.") and ".models." in name]


@cache
def _place_socket() -> None:
    """Place the socket of the server that starts processes in a scratch directory, which ends with this process."""
    held = ExitStack()
    Finalize(None, held.close, exitpriority=-200)  # after the removal of the socket, at -100
    before = tempfile.tempdir
    if len(str(temporary_directory())) > MAX_SOCKET_PLACE:
        tempfile.tempdir = "/tmp"
    try:
        tempfile.tempdir = str(held.enter_context(scratch_directory()))
        get_temp_dir()
    finally:
        tempfile.tempdir = before


@contextmanager
def _without_program() -> Iterator[None]:
    """Hide the program that runs from processes that start, which would else run its file again.

    They need nothing of it, and a short program has no ``if __name__ == "__main__"``.
    """
    with _STARTING:
        program = sys.modules["__main__"]
        sys.modules["__main__"] = ModuleType("__main__")
        try:
            yield
        finally:
            sys.modules["__main__"] = program


def _kill(process: ForkServerProcess) -> None:
    """Kill a process and all of its session, such as programs of OpenFOAM, even if the process itself has ended."""
    assert process.pid is not None
    kill_session(process.pid)


@contextmanager
def local(count: int, scratch: Path) -> Iterator[Processes]:
    """Yield an executor with ``count`` processes on this machine; their temporary files are in ``scratch``."""
    for name in THREADS:
        os.environ.setdefault(name, "1")
    with Processes(count, scratch) as executor:
        yield executor


def workers(processes: int, scratch: Path) -> AbstractContextManager[Processes | None]:
    """Context manager of so many processes of this machine; of None, for this process, if one is asked."""
    return nullcontext() if processes == 1 else local(processes, scratch)


def _work(pipe: Connection, alive: Connection, scratch: Path) -> None:
    """Execute calls until the sender ends, in a session of its own that Ctrl-C does not interrupt."""
    os.setsid()
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    tempfile.tempdir = str(scratch)
    threading.Thread(target=_end_with, args=(alive,), daemon=True).start()
    with suppress(EOFError, OSError):  # the sender has ended
        while True:
            pipe.send(_answer(pipe.recv()))


def _end_with(alive: Connection) -> None:
    """End this process and its children when the only writer of ``alive`` closes it or dies."""
    alive.poll(None)
    kill_session(os.getpid())


def _answer(call: Callable[[], Any]) -> tuple[Any, Exception | None]:
    try:
        return call(), None
    except Exception as error:
        return None, error
