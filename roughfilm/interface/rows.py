"""Tables as lists of rows."""

from typing import Any


class Rows(list[dict[str, Any]]):
    """Rows of a table, each a dict from column to number or text, and the SI ``units`` of the columns by name."""

    def __init__(self) -> None:
        super().__init__()
        self.units: dict[str, str] = {}
