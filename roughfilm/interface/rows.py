"""A table as a list of rows."""

from typing import Any


class Rows(list[dict[str, Any]]):
    """The rows of a table, each a dict from column to number or text; ``units`` holds the SI unit of each column."""

    def __init__(self) -> None:
        super().__init__()
        self.units: dict[str, str] = {}

    def __repr__(self) -> str:
        columns = list(dict.fromkeys(name for row in self for name in row))
        named = [f"{name} ({unit})" if (unit := self.units.get(name, "1")) != "1" else name for name in columns]
        return f"<{len(self)} rows of {len(columns)} columns: {', '.join(named)}>"
