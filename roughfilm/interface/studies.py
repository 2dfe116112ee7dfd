"""Studies: scenes with lists of values, whose cases are solved in parallel and stored in a directory."""

import os
from typing import Any

from numpy.typing import NDArray

from roughfilm import ladder
from roughfilm.batch.directory import alone
from roughfilm.batch.execute import refuse_lost
from roughfilm.batch.executors import MOST_PROCESSES, workers
from roughfilm.batch.progress import BatchProgress
from roughfilm.batch.solve import solved_table
from roughfilm.contact.foundation.errors import unwritable
from roughfilm.contact.foundation.ranges import whole_in_range
from roughfilm.contact.foundation.reading.regular import named_path
from roughfilm.rom.ladder.model import Progress, silent
from roughfilm.rom.studies import study, table


def load_study(path: str | os.PathLike[str]) -> study.Study:
    """Read a study file: a scene in which lists of values are swept, in every combination.

    Parameters
    ----------
    path : the study file (TOML). ``[study]`` names models, resolutions and schemes; ``[[variants]]`` change several
        entries together.

    Returns
    -------
    Study
        ``cases`` hold ``name``, ``scene`` and the ``varied`` values; ``settings`` hold model, resolution and scheme.

    Raises
    ------
    InputError
        If a key, a value or a case is wrong: one line with place, value and remedy.
    UnavailableError
        If a model that the study names cannot run on this machine.

    Examples
    --------
    >>> import roughfilm as rf
    >>> study = rf.load_study("scripts/examples/studies/pocket.toml")
    >>> len(study.cases), [setting.name for setting in study.settings]
    (12, ['reynolds', 'inertial_reynolds'])
    """
    return study.load_study(named_path("path", path), ladder.models)


def run_study(
    path: str | os.PathLike[str],
    out: str | os.PathLike[str],
    *,
    processes: int | None = None,
    progress: Progress = silent,
) -> dict[str, NDArray[Any]]:
    """Solve every case of a study by every model in parallel; a new call continues one that was stopped.

    Parameters
    ----------
    path : the study file (TOML), as :func:`roughfilm.load_study` reads it.
    out : directory of the cases, results and tables; finished results in it are used again.
    processes : number of processes; by default one for each core. With 1 this process solves the cases.
    progress : called with the done fraction and a few words.

    Returns
    -------
    dict of arrays
        The columns of ``out/table.h5``, a row for each case and model, as :func:`roughfilm.read_table` reads them.

    Raises
    ------
    InputError
        If the study is wrong, or the directory is in use or cannot be written. A case that fails does not stop the
        others: the column "outcome" holds the reason.
    UnavailableError
        If a process that solves a case dies twice, for want of memory or by a signal; what is solved is kept.

    Examples
    --------
    >>> import tempfile
    >>> import roughfilm as rf
    >>> with tempfile.TemporaryDirectory() as out:
    ...     table = rf.run_study("scripts/examples/studies/pocket.toml", out, processes=1)
    >>> len(table["model"]), set(table["outcome"].tolist())
    (24, {'solved'})
    """
    processes = len(os.sched_getaffinity(0)) if processes is None else processes
    processes = whole_in_range("processes", processes, 1, MOST_PROCESSES)
    loaded, place = load_study(path), named_path("out", out)
    try:
        place.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise unwritable(f"out: {place}", error, done="made") from error
    counts = BatchProgress()
    with alone(place) as scratch:
        solved_table(loaded, place, counts, workers(processes, scratch), progress)
    refuse_lost([failure for _, failure in counts.failures], len(loaded.cases) * len(loaded.settings), "jobs")
    return read_table(place / "table.h5")


def read_table(path: str | os.PathLike[str]) -> dict[str, NDArray[Any]]:
    """Read the table of a study as columns of one length, ready for pandas.DataFrame.

    Parameters
    ----------
    path : a ``table.h5`` that :func:`roughfilm.run_study` or the command ``batch`` wrote.

    Returns
    -------
    dict of arrays
        Texts, or numbers in SI units, NaN where a number is missing; the datasets of the file have the attribute
        ``unit``.

    Raises
    ------
    InputError
        If the file is missing or is not such a table.

    Examples
    --------
    >>> import roughfilm as rf
    >>> try:
    ...     table = rf.read_table("README.md")
    ... except rf.InputError as error:
    ...     print(error)
    README.md: is not a table of roughfilm; name a table.h5 that 'roughfilm batch' wrote
    """
    return table.read_table(named_path("path", path))
