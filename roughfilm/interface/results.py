"""Writing and reading of result files."""

import os

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.reading.regular import named_path
from roughfilm.rom.ladder import store
from roughfilm.rom.ladder.result import Result


def save(result: Result, path: str | os.PathLike[str], *, overwrite: bool = False) -> None:
    """Write a result with its fields and provenance to an HDF5 file, completely or not at all.

    Parameters
    ----------
    result : the result.
    path : the file, usually ``*.h5``; an existing file of a result is replaced.
    overwrite : whether an existing file of another kind is replaced too.

    Raises
    ------
    InputError
        If the file cannot be written, or holds anything but a result.

    Examples
    --------
    >>> import tempfile
    >>> import roughfilm as rf
    >>> result = rf.solve(rf.load_scene("scripts/examples/scenes/pocket.toml"), model="reynolds")
    >>> with tempfile.TemporaryDirectory() as directory:
    ...     rf.save(result, directory + "/pocket.h5")
    ...     again = rf.load_result(directory + "/pocket.h5")
    >>> again["load"] == result["load"]
    True
    """
    if not isinstance(result, Result):
        raise InputError(f"result: got {type(result).__name__}; give a Result, such as solve() returns")
    store.save(result, named_path("path", path), overwrite=overwrite)


def load_result(path: str | os.PathLike[str]) -> Result:
    """Read a result that :func:`roughfilm.save` or the option ``--out`` of a command wrote.

    Parameters
    ----------
    path : the HDF5 file.

    Returns
    -------
    Result
        Quantities with unit and uncertainty, fields as NumPy arrays, numerics and provenance, as they were stored.

    Raises
    ------
    InputError
        If the file is missing, or is not a result of this package.

    Examples
    --------
    >>> import roughfilm as rf
    >>> try:
    ...     rf.load_result("README.md")
    ... except rf.InputError as error:
    ...     print(error)
    README.md: is not a result of roughfilm; name an .h5 file that it wrote
    """
    return store.load(named_path("path", path))
