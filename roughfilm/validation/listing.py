"""The published sources that the code answers, listed from their modules."""

import importlib
import pkgutil

from roughfilm.validation import sources
from roughfilm.validation.published import Source


def names() -> list[str]:
    """The names of all sources, in alphabetical order, without importing them."""
    return sorted(module.name for module in pkgutil.iter_modules(sources.__path__))


def source(name: str) -> Source:
    """The source of a module in ``roughfilm.validation.sources``."""
    found: Source = importlib.import_module(f"{sources.__name__}.{name}").SOURCE
    return found
