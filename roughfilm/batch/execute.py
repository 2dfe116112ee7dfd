"""Execution of many jobs by any workers: they are sent in chunks, the most expensive first."""

import platform
import signal
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import CancelledError, Executor, Future
from contextlib import contextmanager
from dataclasses import dataclass, replace
from queue import Empty, SimpleQueue
from signal import SIGINT, SIGTERM
from typing import Any, Protocol, TypeVar

from roughfilm.batch.jobs import Failure, Job, failure_of
from roughfilm.contact.foundation.errors import UnavailableError
from roughfilm.contact.foundation.timing import stopwatch
from roughfilm.ladder import find
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.provenance import code, versions
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.setting import Setting
from roughfilm.rom.ladder.store import as_bytes

CHUNK_S = 0.25
"""Expected CPU time of a chunk of jobs, s.

It is much longer than the time to send a chunk, and short enough to be repeated if a worker dies.
"""

STORING_S = 3e-3
"""CPU time to write a result to a file, s; for the cheapest models this is most of the cost."""

WATCH_S = 1.0
"""Time without an answer after which the workers are watched, s."""

ONE_AT_A_TIME = threading.Lock()
"""Held while jobs run: a worker of dask may have several threads, but models and CPU times are those of a process."""

WORKER_DIED = "WorkerDied"
"""The kind of the failure of a job whose worker died twice."""

GONE = "the scheduler is gone; what is stored stays, start again"

QuestionT = TypeVar("QuestionT")
AnswerT = TypeVar("AnswerT")

Question = tuple[Scene, str, int | None, str | None, str]
"""A job in the form that workers receive: scene, name of the model, resolution, scheme, and the programs that the model
needs, in the words of its availability; workers write no files."""


@dataclass(frozen=True, kw_only=True)
class Solved:
    """A result without its fields, and the complete result as the bytes of its file."""

    result: Result
    file: bytes


Answer = Solved | Failure


class Workers(Protocol):
    """Processes that run jobs, on this machine or on others."""

    def executor(self, needs: str | None = None) -> Executor:
        """The executor of all workers, or of those that can run models with the availability ``needs``, in words."""

    def watch(self) -> None:
        """Raise UnavailableError if all workers are gone for too long."""


def expected_cost(job: Job) -> float:
    """The expected CPU time of a job, s, including the time to write its file."""
    return job.setting.cost(job.scene) + STORING_S


def run(jobs: Sequence[Job], workers: Workers | None) -> Iterator[tuple[Job, Answer]]:
    """Send every job to a worker and yield each job with its answer, in the order of the answers.

    Without workers this process solves the jobs.

    An error in one job does not stop the others. If a worker dies, or has not what a job needs, the jobs of its chunk
    are sent again one by one; a job to which this happens twice has failed.

    Raises
    ------
    SystemExit
        If the process receives SIGINT or SIGTERM; a signal that it ignores, as with nohup, stays ignored.
    UnavailableError
        If the scheduler of the workers stops, or all workers are gone.
    """
    if workers is None:
        yield from ((job, _answer(job.scene, job.setting)) for job in jobs)
        return
    origin = (code(), versions())

    def send(chunk: list[Job], again: bool) -> Future[list[Answer]]:
        questions = [_question(job) for job in chunk]
        return workers.executor(questions[0][-1] if again else None).submit(ask, questions, origin)

    yield from answered(chunks(jobs), send, lost, workers)


def answered(
    chunks: Iterable[list[QuestionT]],
    send: Callable[[list[QuestionT], bool], Future[list[AnswerT]]],
    lost: Callable[[BaseException], AnswerT],
    workers: Workers,
) -> Iterator[tuple[QuestionT, AnswerT]]:
    """Send chunks of questions to workers and yield each question with its answer; raises as :func:`run`.

    Parameters
    ----------
    chunks : the questions, in the order in which they are sent.
    send : send(chunk, again) submits a chunk, ``again`` if it failed before; its answers are those to the first
        questions of the chunk, one at least, and the others are sent again.
    lost : the answer to a question whose worker raised an error twice.
    workers : the workers.
    """
    pending: dict[Future[list[AnswerT]], tuple[list[QuestionT], bool]] = {}
    finished: SimpleQueue[Future[list[AnswerT]] | int] = SimpleQueue()

    def submit(chunk: list[QuestionT], again: bool) -> None:
        future = send(chunk, again)
        pending[future] = (chunk, again)
        future.add_done_callback(finished.put)

    with _signals_to(finished):
        for chunk in chunks:
            submit(chunk, False)
        while pending:
            try:
                future = finished.get(timeout=WATCH_S)
            except Empty:
                workers.watch()
                continue
            if isinstance(future, int):
                raise SystemExit(128 + future)
            chunk, again = pending.pop(future)
            try:
                error = future.exception()
            except CancelledError:
                raise UnavailableError(GONE) from None
            if error is None:
                answers = future.result()
                yield from zip(chunk, answers, strict=False)
                if rest := chunk[len(answers) :]:
                    submit(rest, again)
            elif again:
                yield chunk[0], lost(error)
            else:
                for question in chunk:
                    submit([question], True)


@contextmanager
def _signals_to(queue: SimpleQueue[Any]) -> Iterator[None]:
    """Put the numbers of SIGINT and SIGTERM into a queue; exceptions from signal handlers could be lost."""
    before = {number: signal.getsignal(number) for number in (SIGINT, SIGTERM)}
    for number, handler in before.items():
        if handler is not signal.SIG_IGN:
            signal.signal(number, lambda got, _: queue.put(got))
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def lost(error: BaseException) -> Failure:
    """The failure of a job whose worker raised an error twice."""
    if isinstance(error, UnavailableError):
        return failure_of(error)
    message = f"its worker died twice ({type(error).__name__}); if memory is short, run fewer jobs at a time"
    return Failure(kind=WORKER_DIED, message=message)


def refuse_lost(failures: Sequence[Failure], count: int, words: str) -> None:
    """Raise UnavailableError if a worker died on one of ``count`` ``words``, such as "jobs"."""
    died = [failure for failure in failures if failure.kind == WORKER_DIED]
    if died:
        raise UnavailableError(
            f"{len(died)} of {count} {words}: {died[0].message}; what is solved stays, the same call goes on"
        )


def chunks(jobs: Iterable[Job]) -> Iterator[list[Job]]:
    """Yield the jobs from the most to the least expensive, in chunks with an expected CPU time of about ``CHUNK_S``."""
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
    return job.scene, setting.model.name, setting.resolution, setting.scheme, setting.model.available().detail


def ask(questions: Sequence[Question], origin: tuple[str, dict[str, Any]]) -> list[Answer]:
    """Compute the answers to questions in order, in a worker; other calls in its process wait.

    After twice the time ``CHUNK_S`` no further question is started, so that the result may be shorter than the input.

    Raises UnavailableError if the worker's code or libraries are not those of ``origin``, or its programs are not those
    that the first question needs.
    """
    host = refuse_other_code(origin)
    answers: list[Answer] = []
    with ONE_AT_A_TIME:
        end = time.monotonic() + 2 * CHUNK_S
        for scene, name, resolution, scheme, needs in questions:
            model = find(scene.kind, name)
            has = model.available().detail
            if answers and (time.monotonic() > end or has != needs):
                break
            if has != needs:
                raise UnavailableError(f"{host}: {name} needs {needs} ({has})")
            answers.append(_answer(scene, Setting(model=model, resolution=resolution, scheme=scheme)))
    return answers


def refuse_other_code(origin: tuple[str, dict[str, Any]]) -> str:
    """The name of this machine; UnavailableError if its code or libraries are not those of ``origin``."""
    host = platform.node()
    if origin != (code(), versions()):
        raise UnavailableError(f"{host}: has other code or libraries than the sender; install the same there")
    return host


def _answer(scene: Scene, setting: Setting) -> Answer:
    spent = stopwatch()
    try:
        result = setting.solve(scene)
        return Solved(result=replace(result, fields={}), file=as_bytes(result))
    except Exception as error:  # any error of a model is a failure of this job alone
        return replace(failure_of(error), cpu_s=spent()["cpu_s"])
