"""Functions whose modules are imported at the first call, for tables that name functions of slow modules."""

from collections.abc import Callable
from importlib import import_module
from typing import Any


def deferred(module: str, name: str) -> Callable[..., Any]:
    """The function of a module whose import waits until the first call.

    Parameters
    ----------
    module : dotted name of the module within ``roughfilm``.
    name : name of the function in that module.

    Examples
    --------
    >>> to_si = deferred("contact.foundation.units", "to_si")
    >>> to_si("30 um", "m")
    3e-05
    """

    def call(*arguments: Any, **options: Any) -> Any:
        return getattr(import_module(f"roughfilm.{module}"), name)(*arguments, **options)

    return call
