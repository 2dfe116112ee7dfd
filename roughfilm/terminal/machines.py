"""Options of the commands that name the machines on which many computations run."""

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.units import to_si

MOST_WAIT_S = 30 * 86400
"""Longest time to wait for workers, s."""

WAIT = "10 min"
"""Default time to wait for workers."""


class Where(StrEnum):
    """The machines on which the jobs run."""

    LOCAL = "local"
    DASK = "dask"


OnMachines = Annotated[Where, typer.Option("--executor", help="Run the jobs on this machine, or on a dask cluster.")]
Scheduler = Annotated[
    str | None, typer.Option("--scheduler", metavar="ADDRESS", help="Address of the dask scheduler: tls://HOST:PORT.")
]
Keys = Annotated[
    Path | None,
    typer.Option("--tls", metavar="DIR", help="Keys for the scheduler, as 'roughfilm cluster keys DIR' writes them."),
]
Wait = Annotated[str, typer.Option("--wait", metavar="TIME", help="End if the scheduler has no workers for this time.")]


def waiting_time(executor: Where, scheduler: str | None, tls: Path | None, wait: str) -> float:
    """The time to wait for workers, s; InputError if the options do not fit together."""
    limit = _seconds(wait)
    if executor is Where.DASK and scheduler is None:
        raise InputError("--executor dask needs --scheduler ADDRESS")
    if executor is Where.LOCAL and scheduler is not None:
        raise InputError(f"--scheduler: got {scheduler} with --executor local; add --executor dask")
    if tls is not None and scheduler is None:
        raise InputError(f"--tls: got {tls} with --executor {executor}; local takes none")
    return limit


def _seconds(wait: str) -> float:
    try:
        seconds = to_si(wait, "s")
    except ValueError as error:
        raise InputError(f"--wait: {error}") from None
    if not 0 <= seconds <= MOST_WAIT_S:
        raise InputError(f"--wait: got {wait!r}; it must be 0 s to {MOST_WAIT_S / 86400:g} d")
    return seconds
