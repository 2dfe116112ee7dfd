"""Short texts of records that hold arrays, for the prompt of Python and for notebooks."""

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
