"""Functions whose modules are imported when they are called, for data that name what is slow to import."""

from collections.abc import Callable
from importlib import import_module
from typing import Any


def deferred(module: str, name: str) -> Callable[..., Any]:
    """The function of that name, whose module in ``roughfilm`` is imported at its first call.

    Examples
    --------
    >>> to_si = deferred("contact.foundation.units", "to_si")
    >>> to_si("30 um", "m")
    3e-05
    """

    def call(*arguments: Any, **options: Any) -> Any:
        return getattr(import_module(f"roughfilm.{module}"), name)(*arguments, **options)

    return call
