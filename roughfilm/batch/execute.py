"""Many jobs through any executor: sent in chunks, the dearest first, and answered one by one."""

import os
import platform
import signal
import time
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import CancelledError, Executor, Future
from contextlib import contextmanager
from dataclasses import dataclass, replace
from queue import SimpleQueue
from signal import SIGINT, SIGTERM
from typing import Any

from roughfilm.batch.jobs import Failure, Job, failure_of
from roughfilm.contact.foundation.errors import UnavailableError
from roughfilm.ladder import find
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.provenance import code, versions
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.setting import Setting
from roughfilm.rom.ladder.store import as_bytes

CHUNK_S = 0.25
"""Expected seconds of a chunk: long against sending it, short against what a kill may cost."""

STORING_S = 3e-3
"""CPU seconds to make a result into a file, which is most of what the cheapest models take."""


@dataclass(frozen=True, kw_only=True)
class Question:
    """A job as a worker gets it: the model by its name, and no path, because only the sender writes."""

    scene: Scene
    model: str
    resolution: int | None
    scheme: str | None


@dataclass(frozen=True, kw_only=True)
class Solved:
    """A result without its fields, and the whole of it as the bytes of its file."""

    result: Result
    file: bytes


Answer = Solved | Failure


def expected_cost(job: Job) -> float:
    """CPU seconds of a job with making its file."""
    return job.setting.cost(job.scene) + STORING_S


def run(jobs: Sequence[Job], executor: Executor) -> Iterator[tuple[Job, Answer]]:
    """Send every job and yield each with its answer as it comes; an error of one job stops no other.

    A chunk that is lost because its worker died is sent again job by job; a job that is lost twice has failed.
    """
    pending: dict[Future[list[Answer]], tuple[list[Job], bool]] = {}
    finished: SimpleQueue[Future[list[Answer]] | int] = SimpleQueue()
    origin = (code(), versions())

    def send(chunk: list[Job], again: bool) -> None:
        future = executor.submit(ask, [_question(job) for job in chunk], origin)
        pending[future] = (chunk, again)
        future.add_done_callback(finished.put)

    with _signals_to(finished):
        for chunk in chunks(jobs):
            send(chunk, False)
        while pending:
            future = finished.get()
            if isinstance(future, int):
                raise SystemExit(128 + future)
            chunk, again = pending.pop(future)
            try:
                error = future.exception()
            except CancelledError:
                raise UnavailableError("the scheduler is gone; what is stored stays, start again") from None
            if error is None:
                answers = future.result()
                yield from zip(chunk, answers, strict=False)
                if rest := chunk[len(answers) :]:
                    send(rest, again)
            elif again:
                yield chunk[0], _lost(error)
            else:
                for job in chunk:
                    send([job], True)


@contextmanager
def _signals_to(queue: SimpleQueue[Any]) -> Iterator[None]:
    """Put the numbers of the signals that end a program into a queue: an exception raised by them may get lost."""
    before = {number: signal.signal(number, lambda got, _: queue.put(got)) for number in (SIGINT, SIGTERM)}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def _lost(error: BaseException) -> Failure:
    if isinstance(error, UnavailableError):
        return failure_of(error)
    told = f"its worker died twice ({type(error).__name__}); if memory is short, let fewer run at a time"
    return Failure(kind="WorkerDied", message=told)


def chunks(jobs: Iterable[Job]) -> Iterator[list[Job]]:
    """The jobs from the dearest to the cheapest, the cheap ones together until they take ``CHUNK_S``."""
    chunk: list[Job] = []
    total = 0.0
    for job in sorted(jobs, key=expected_cost, reverse=True):
        chunk.append(job)
        total += expected_cost(job)
        if total >= CHUNK_S:
            yield chunk
            chunk, total = [], 0.0
    if chunk:
        yield chunk


def _question(job: Job) -> Question:
    setting = job.setting
    return Question(scene=job.scene, model=setting.model.name, resolution=setting.resolution, scheme=setting.scheme)


def ask(questions: Sequence[Question], origin: tuple[str, dict[str, Any]]) -> list[Answer]:
    """Answer the questions in turn, in a worker; those that do not fit into twice the time of a chunk are left.

    Raises UnavailableError where the worker's code or libraries are not those of ``origin``.
    """
    if origin != (code(), versions()):
        host = platform.node()
        raise UnavailableError(f"{host}: has other code or libraries than the sender; install the same there")
    end = time.monotonic() + 2 * CHUNK_S
    answers: list[Answer] = []
    for question in questions:
        if answers and time.monotonic() > end:
            break
        before = sum(os.times()[:4])  # of this process, which has one job at a time, and of its ended children
        try:
            model = find(question.scene.kind, question.model)
            setting = Setting(model=model, resolution=question.resolution, scheme=question.scheme)
            result = setting.solve(question.scene)
            answers.append(Solved(result=replace(result, fields={}), file=as_bytes(result)))
        except Exception as error:  # whatever a model raises is one job's failure
            answers.append(replace(failure_of(error), cpu_s=sum(os.times()[:4]) - before))
    return answers
