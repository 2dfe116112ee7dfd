"""The standard streams of a command: closed, full, or with a reader that ends early, they give no traceback."""

import io
import os
import sys
from contextlib import suppress
from typing import Any, TextIO

from roughfilm.contact.foundation.errors import InputError
from roughfilm.terminal.layout import CHARSET_ERRORS


class _Stream(io.FileIO):
    """A standard stream to which nothing is written any more once its reader has ended or it cannot be written.

    A reader that ends early, as ``head`` does, is no failure: the command goes on to its end, writes its files, and
    has the exit code that it has without a reader.
    """

    def write(self, data: Any) -> int:
        """Write bytes; InputError if standard output cannot be written, and nothing if standard error cannot."""
        try:
            return super().write(data)
        except OSError as error:
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, self.fileno())
            os.close(nowhere)
            if isinstance(error, BrokenPipeError) or self.fileno() == 2:
                return memoryview(data).nbytes
            reason = error.strerror or str(error)
            raise InputError(f"standard output: cannot be written ({reason}); send it elsewhere") from None


def prepare_streams() -> None:
    """Open the standard streams that are closed, and make those of output such that a failure is one line.

    A closed standard output stays one that cannot be written. Characters that a stream lacks are replaced.
    """
    for number, access in enumerate((os.O_RDONLY, os.O_RDONLY, os.O_WRONLY)):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, access)  # takes the smallest number, which is this one
    sys.stdout = _prepared(sys.stdout, sys.__stdout__, 1)
    sys.stderr = _prepared(sys.stderr, sys.__stderr__, 2)


def _prepared(stream: TextIO | None, original: TextIO | None, number: int) -> TextIO:
    """The stream of a descriptor; one that a caller has put in its place is kept."""
    if stream is not None and stream is not original:
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors=CHARSET_ERRORS)
        return stream
    if stream is not None:
        with suppress(OSError):
            stream.flush()
    raw = io.BufferedWriter(_Stream(number, "wb", closefd=False))
    encoding = "utf-8" if stream is None else stream.encoding
    return io.TextIOWrapper(raw, encoding=encoding, errors=CHARSET_ERRORS, line_buffering=True)
