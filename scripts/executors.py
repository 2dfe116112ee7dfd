"""Where jobs run: in processes of this machine, or on a dask cluster; both as ``concurrent.futures`` executors."""

import asyncio
import logging
import multiprocessing
import os
import signal
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager, suppress
from multiprocessing.connection import Connection
from pathlib import Path
from types import FrameType
from typing import Any

from contact.errors import UnavailableError
from scripts.common import messages

SCHEDULER_TIMEOUT_S = 5

THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
"""Set to 1 where the user says nothing: the cores are kept busy by jobs, not by the libraries inside one."""


class Processes(ThreadPoolExecutor):
    """Each thread keeps a process, so that a process that dies takes the one call with it that ran there.

    The processes live as long as ``alive`` has a writer: they end themselves when it is closed, or when this process
    dies in whatever way.
    """

    def __init__(self, count: int, scratch: Path) -> None:
        super().__init__(count)
        self._context = multiprocessing.get_context("forkserver")
        self._context.set_forkserver_preload(["scripts.sweep"])
        self._scratch = scratch
        self._alive, self._writer = self._context.Pipe(duplex=False)
        self._own = threading.local()

    def submit(self, call: Callable[..., Any], /, *arguments: Any, **options: Any) -> Future[Any]:
        """Call in one of the processes; raises BrokenProcessPool there if the process dies."""
        return super().submit(self._in_process, call, *arguments, **options)

    def _in_process(self, call: Callable[..., Any], *arguments: Any, **options: Any) -> Any:
        if not hasattr(self._own, "pool"):
            pool = ProcessPoolExecutor(1, self._context, initializer=_start, initargs=(self._alive, self._scratch))
            self._own.group = pool.submit(os.getpid).result()
            self._own.pool = pool
        try:
            return self._own.pool.submit(_call, call, *arguments, **options).result()
        except BrokenProcessPool:
            with suppress(ProcessLookupError):
                os.killpg(self._own.group, signal.SIGKILL)  # what the dead process had started
            del self._own.pool
            raise

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = True) -> None:
        """End the processes at once; calls that are not finished are lost."""
        super().shutdown(wait=False, cancel_futures=cancel_futures)
        self._writer.close()
        super().shutdown(wait=wait)


@contextmanager
def local(count: int, scratch: Path) -> Iterator[Executor]:
    """An executor of that many processes here; their temporary files go to ``scratch``."""
    for name in THREADS:
        os.environ.setdefault(name, "1")
    with Processes(count, scratch) as executor:
        yield executor


@contextmanager
def dask(address: str) -> Iterator[Executor]:
    """The executor of a running dask cluster, whose workers have roughfilm installed.

    Raises UnavailableError if dask is not installed or the scheduler does not answer.
    """
    try:
        import distributed
    except ImportError:
        told = "--executor dask: needs the library distributed; install it with: pip install 'roughfilm[cluster]'"
        raise UnavailableError(told) from None
    logging.disable()  # dask and tornado would say in many lines what we say in one
    try:
        asyncio.run(asyncio.wait_for(_greet(address), SCHEDULER_TIMEOUT_S))
        client = distributed.Client(address, set_as_default=False)
    except Exception as error:  # whatever answers there may send anything
        reason = " ".join(str(error).split()) or f"silent for {SCHEDULER_TIMEOUT_S} s"
        told = f"--scheduler {address}: is no dask scheduler that answers ({reason}); start one with: dask scheduler"
        raise UnavailableError(told) from None
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


def _start(alive: Connection, scratch: Path) -> None:
    """In a new process: a group of its own, temporary files in their place, and an end with the parent."""
    os.setpgrp()
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, _leave)
    tempfile.tempdir = str(scratch)
    threading.Thread(target=_end_with, args=(alive,), daemon=True).start()


def _end_with(alive: Connection) -> None:
    alive.poll(None)
    while True:
        os.kill(os.getpid(), signal.SIGTERM)
        time.sleep(SCHEDULER_TIMEOUT_S)


def _leave(number: int, _frame: FrameType | None) -> None:
    sys.exit(128 + number)


def _call(call: Callable[..., Any], *arguments: Any, **options: Any) -> Any:
    try:
        return call(*arguments, **options)
    except SystemExit:
        os._exit(128 + signal.SIGTERM)  # the pool would take it for an answer and wait for the next call
