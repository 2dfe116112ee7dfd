"""How many threads a command shares its work among."""

import os
from typing import Annotated

import typer

from roughfilm.contact.foundation.errors import InputError

MOST = 256

Threads = Annotated[int | None, typer.Option(help="Gaps whose flow is solved at once; two where there are two cores.")]


def chosen_threads(threads: int | None) -> int:
    """The threads asked for, or two; InputError if they are none or too many."""
    if threads is None:
        return min(2, os.cpu_count() or 1)
    if not 1 <= threads <= MOST:
        raise InputError(f"--threads: got {threads} threads; it must be 1 to {MOST}")
    return threads
