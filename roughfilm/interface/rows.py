"""A table as a list of rows."""

from typing import TYPE_CHECKING, Any

from roughfilm.contact.foundation.errors import UnavailableError

if TYPE_CHECKING:
    import pandas


class Rows(list[dict[str, Any]]):
    """The rows of a table, each a dict from column to number or text; ``units`` holds the SI unit of each column."""

    def __init__(self) -> None:
        super().__init__()
        self.units: dict[str, str] = {}

    def __repr__(self) -> str:
        columns = list(dict.fromkeys(name for row in self for name in row))
        named = [f"{name} ({unit})" if (unit := self.units.get(name, "1")) != "1" else name for name in columns]
        return f"<{len(self)} rows of {len(columns)} columns: {', '.join(named)}>"

    def to_dataframe(self) -> "pandas.DataFrame":
        """The rows as a table of pandas, an optional library; ``attrs["units"]`` holds the unit of each column.

        A number that a row lacks is NaN there.

        Raises
        ------
        UnavailableError
            If pandas is not installed.
        """
        try:
            import pandas
        except ImportError:
            raise UnavailableError("pandas: not installed; install it with: pip install 'roughfilm[data]'") from None
        table = pandas.DataFrame(list(self))
        table.attrs["units"] = dict(self.units)
        return table
