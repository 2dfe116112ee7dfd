"""A table as a list of rows."""

from typing import Any


class Rows(list[dict[str, Any]]):
    """The rows of a table, each a dict from column to number or text; ``units`` holds the SI unit of each column."""

    def __init__(self) -> None:
        super().__init__()
        self.units: dict[str, str] = {}
