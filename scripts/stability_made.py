"""What a map of where solvers converge is made of, whatever is mapped."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Protocol

from rich.table import Table

from rom.table import Column


@dataclass(frozen=True, kw_only=True)
class Made:
    """A finished map: ``entries`` for JSON, ``columns`` for CSV, ``table`` to print, and the page from its template.

    ``page`` holds what the template needs beside the entries, ``absent`` what was left out, with the reason.
    """

    entries: Mapping[str, Any]
    columns: Mapping[str, Column]
    table: Table
    template: str
    page: Mapping[str, Any]
    absent: Mapping[str, str] = field(default_factory=dict)


class Family(Protocol):
    """What is mapped; ``resolution`` is the default, ``resolution_meaning`` says in words what it counts."""

    @property
    def resolution(self) -> int:
        """By default."""
        ...

    @property
    def resolution_meaning(self) -> str:
        """What it counts."""
        ...

    def make(self, *, resolution: int, out: Path, processes: int, scratch: Path) -> Made:
        """Solve what is not in ``out`` already, and put all of it together."""
        ...
