"""Messages about options of a command, as messages about the arguments of a function."""

import re
from collections.abc import Iterator
from contextlib import contextmanager

from roughfilm.contact.foundation.errors import InputError

ARGUMENTS = {"want": "quantity"}
"""Arguments whose name differs from that of the option."""


@contextmanager
def argument_names() -> Iterator[None]:
    """Decorate a function: an InputError that begins with ``--model`` begins with ``model`` instead.

    Examples
    --------
    >>> with argument_names():
    ...     raise InputError("--want: got 'lift'; it must be 'load'")
    Traceback (most recent call last):
    roughfilm.contact.foundation.errors.InputError: quantity: got 'lift'; it must be 'load'
    """
    try:
        yield
    except InputError as error:
        if option := re.match(r"--(\w+)", str(error)):
            name = ARGUMENTS.get(option[1], option[1])
            raise InputError(name + str(error)[option.end() :]) from None
        raise
