"""Short texts: of records that hold arrays, for the prompt of Python, and of values in messages."""

import re
from dataclasses import fields, is_dataclass
from reprlib import Repr
from typing import Any


class _Brief(Repr):
    """Texts of values: arrays by their shape, tables by their keys, long texts and records shortened."""

    def __init__(self) -> None:
        super().__init__()
        self.maxtuple = self.maxlist = self.maxfrozenset = 4
        self.maxstring = self.maxother = 60

    def repr_ndarray(self, values: Any, _level: int) -> str:
        return f"<array {'×'.join(map(str, values.shape))}>" if values.ndim else repr(values.item())

    def repr_dict(self, table: Any, _level: int) -> str:
        return f"<{', '.join(map(str, table)):.60}>" if table else "{}"

    def repr_function(self, function: Any, _level: int) -> str:
        return f"<function {function.__name__}>"

    def repr_instance(self, record: Any, level: int) -> str:
        whole = repr(record)
        if len(whole) > self.maxother and is_dataclass(record):
            return f"{type(record).__name__}(...)"
        return super().repr_instance(record, level)


_BRIEF = _Brief()


def brief(record: Any) -> str:
    """The text of a dataclass on one line: arrays by their shape, tables by their keys, long values shortened.

    Parameters
    ----------
    record : a dataclass; fields without ``repr`` are left out.

    Examples
    --------
    >>> from dataclasses import dataclass
    >>> import numpy as np
    >>> @dataclass
    ... class Pressed:
    ...     load: float
    ...     gap: np.ndarray
    ...     __repr__ = brief
    >>> Pressed(1e6, np.zeros((64, 32)))
    Pressed(load=1000000.0, gap=<array 64×32>)
    """
    parts = (f"{field.name}={_BRIEF.repr(getattr(record, field.name))}" for field in fields(record) if field.repr)
    return f"{type(record).__name__}({', '.join(parts)})"


VALUE_LENGTH = 80
"""Largest number of characters of a value in a message."""

WORD_LENGTH = 255
"""Largest number of characters of a word that stands in a message without quotes, such as a path."""

LINE_LENGTH = 2000
"""Largest number of characters of a line of a message."""

_QUOTED = re.compile(rf"""(?<![\w'"])(['"])([^'"\n]{{{VALUE_LENGTH},}})\1(?!\w)""")
_WORD = re.compile(rf"\S{{{WORD_LENGTH},}}")


def shortened(text: str, length: int = VALUE_LENGTH) -> str:
    """The text, with dots in place of its middle where it has more characters than ``length``.

    >>> shortened("a" * 50 + "b" * 50, 10)
    'aaaaaa…bbb'
    """
    if len(text) <= length:
        return text
    end = length // 3
    return f"{text[: length - end - 1]}…{text[len(text) - end :]}"


def short_message(message: str) -> str:
    """A message whose quoted values, words and lines are shortened where they are very long.

    >>> len(short_message(f"{'x' * 100_000!r} is no kind"))
    93
    """
    lines = (
        _QUOTED.sub(lambda found: f"{found[1]}{shortened(found[2])}{found[1]}", line) for line in message.split("\n")
    )
    return "\n".join(shortened(_WORD.sub(lambda word: shortened(word[0]), line), LINE_LENGTH) for line in lines)
