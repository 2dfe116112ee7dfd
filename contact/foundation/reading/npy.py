"""NPY files of numbers, whose header is checked against the length of the file before memory is allocated."""

import math
import warnings
from dataclasses import dataclass
from pathlib import Path
from tokenize import TokenError
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.reading.regular import opened

DAMAGED_HEADER = (ValueError, TypeError, LookupError, SyntaxError, TokenError, RecursionError, MemoryError)
"""Errors with which NumPy refuses a damaged header."""


@dataclass(frozen=True, kw_only=True)
class Header:
    """The header of an array: ``shape``, ``dtype``, whether it is stored in Fortran order, and where its data begin."""

    shape: tuple[int, ...]
    dtype: np.dtype[Any]
    fortran: bool
    start: int


def read_header(path: Path, remedy: str) -> Header:
    """The header of an NPY file of numbers.

    Parameters
    ----------
    path : the file.
    remedy : the end of the error message.

    Raises
    ------
    InputError
        If the file cannot be read, is not NPY, holds anything but numbers, or is shorter than its header claims.
    """
    with opened(path, remedy) as file:
        try:
            version = np.lib.format.read_magic(file)
            read = {(1, 0): np.lib.format.read_array_header_1_0, (2, 0): np.lib.format.read_array_header_2_0}[version]
            with warnings.catch_warnings(action="ignore"):  # of headers that Python 2 wrote
                shape, fortran, dtype = read(file)
        except DAMAGED_HEADER as error:
            raise InputError(f"{path}: is no whole NPY array; {remedy}") from error
        header = Header(shape=shape, dtype=dtype, fortran=fortran, start=file.tell())
        length = file.seek(0, 2) - header.start
    if dtype.kind not in "fiu":
        raise InputError(f"{path}: got {dtype!s:.60} of shape {shape}; {remedy}")
    if min(shape, default=1) < 0 or math.prod(shape) * dtype.itemsize > length:
        raise InputError(f"{path}: is no whole NPY array, its header claims the shape {shape!s:.60}; {remedy}")
    return header


def read_numbers(path: Path, header: Header) -> NDArray[np.float64]:
    """The numbers behind a header as floats, in its shape."""
    values = np.fromfile(path.expanduser(), header.dtype, math.prod(header.shape), offset=header.start)
    return np.asarray(values.reshape(header.shape, order="F" if header.fortran else "C"), dtype=np.float64)
