"""Executors of ``concurrent.futures`` that run jobs in processes of this machine or on a dask cluster."""

import asyncio
import logging
import multiprocessing
import os
import signal
import tempfile
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import BrokenExecutor, Executor, Future, ThreadPoolExecutor
from contextlib import contextmanager, suppress
from functools import partial
from multiprocessing import forkserver
from multiprocessing.connection import Connection
from multiprocessing.context import ForkServerProcess
from pathlib import Path
from typing import Any

from roughfilm.contact.foundation.errors import UnavailableError
from roughfilm.terminal.console import messages

SCHEDULER_TIMEOUT_S = 5
THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
"""Environment variables that are set to 1 unless they are set, because the jobs share the cores."""


class Processes(ThreadPoolExecutor):
    """An executor with one process for each thread; if a process dies, only its current call is lost.

    A ``ProcessPoolExecutor`` would then fail every pending call, and would wait forever if the process died while it
    sent an answer. The processes end with the current process or at the shutdown. The caller removes the files that
    they leave in ``scratch``.
    """

    def __init__(self, count: int, scratch: Path) -> None:
        super().__init__(count)
        self._context = multiprocessing.get_context("forkserver")
        self._context.set_forkserver_preload(["roughfilm.batch.execute"])
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


def _kill(process: ForkServerProcess) -> None:
    """Kill a process and its children, even if the process itself has ended."""
    assert process.pid is not None
    with suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)


@contextmanager
def local(count: int, scratch: Path) -> Iterator[Executor]:
    """Yield an executor with ``count`` processes on this machine; their temporary files are in ``scratch``."""
    for name in THREADS:
        os.environ.setdefault(name, "1")
    with Processes(count, scratch) as executor:
        yield executor


@contextmanager
def dask(address: str) -> Iterator[Executor]:
    """Yield the executor of a running dask cluster with roughfilm installed on its workers.

    ``address`` is that of the scheduler, such as "tcp://host:8786".

    Raises UnavailableError if dask is not installed or the scheduler does not answer.
    """
    try:
        import distributed
    except ImportError:
        message = "executor dask: needs the library distributed; install it with: pip install 'roughfilm[cluster]'"
        raise UnavailableError(message) from None
    logging.disable()  # dask and tornado would print many lines in addition to the error
    try:
        asyncio.run(asyncio.wait_for(_greet(address), SCHEDULER_TIMEOUT_S))
        client = distributed.Client(address, set_as_default=False)
    except Exception as error:  # another program at this address may send anything
        reason = " ".join(str(error).split()) or f"silent for {SCHEDULER_TIMEOUT_S} s"
        message = f"scheduler {address}: no dask scheduler answers there ({reason}); start one with: dask scheduler"
        raise UnavailableError(message) from None
    with client:
        if not client.nthreads():
            messages.print(f"{address} has no workers yet; waiting for the first", markup=False, soft_wrap=True)
        yield client.get_executor(pure=False)


async def _greet(address: str) -> None:
    from distributed import rpc

    async with rpc(address) as scheduler:
        kind = (await scheduler.identity())["type"]
    if kind != "Scheduler":
        raise ValueError(f"it is a {kind}")


def _work(pipe: Connection, alive: Connection, scratch: Path) -> None:
    """Execute calls until the sender ends, in a process group of its own that Ctrl-C does not interrupt."""
    os.setpgrp()
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    tempfile.tempdir = str(scratch)
    threading.Thread(target=_end_with, args=(alive,), daemon=True).start()
    with suppress(EOFError, OSError):  # the sender has ended
        while True:
            pipe.send(_answer(pipe.recv()))


def _end_with(alive: Connection) -> None:
    """End this process and its children when the only writer of ``alive`` closes it or dies."""
    alive.poll(None)
    os.killpg(0, signal.SIGKILL)


def _answer(call: Callable[[], Any]) -> tuple[Any, Exception | None]:
    try:
        return call(), None
    except Exception as error:
        return None, error
