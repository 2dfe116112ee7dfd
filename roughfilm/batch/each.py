"""One call for each of several items, in this process or in several processes of this machine."""

from collections.abc import Callable, Sequence
from concurrent.futures import BrokenExecutor, as_completed
from typing import Any, TypeVar

from roughfilm.batch.executors import local
from roughfilm.contact.foundation.errors import UnavailableError
from roughfilm.contact.foundation.writing.scratch import scratch_directory
from roughfilm.rom.ladder.model import Progress

T = TypeVar("T")


def for_each(
    call: Callable[..., T], arguments: Sequence[tuple[Any, ...]], processes: int, progress: Progress, words: str
) -> list[T]:
    """The values of ``call(*one)`` for all arguments, in their order.

    Parameters
    ----------
    call : a function that can be pickled, as can its arguments and values.
    arguments : the arguments of each call.
    processes : number of processes; with one, and for a single call, this process makes the calls.
    progress : called with the done fraction and ``words``, such as "windows", with the number of calls done.

    Raises
    ------
    UnavailableError
        If a process dies.
    Exception
        The first error of a call; what the other calls have written is kept.
    """
    count = len(arguments)

    def done(number: int) -> None:
        progress(number / count, f"{number} of {count} {words}")

    if min(processes, count) == 1:
        values = []
        for number, one in enumerate(arguments):
            done(number)
            values.append(call(*one))
        return values
    with scratch_directory() as scratch, local(min(processes, count), scratch) as executor:
        futures = [executor.submit(call, *one) for one in arguments]
        done(0)
        for number, future in enumerate(as_completed(futures), start=1):
            try:
                future.result()
            except BrokenExecutor:
                raise UnavailableError(f"{words}: a process died; if memory is short, give fewer processes") from None
            done(number)
        return [future.result() for future in futures]
