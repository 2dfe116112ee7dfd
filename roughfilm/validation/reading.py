"""The published tables, as they are stored."""

import csv
import tomllib
from pathlib import Path

TABLES = Path(__file__).parent / "tables"


def published(name: str) -> list[dict[str, str]]:
    """The rows of a table by column, as text, so that the number of printed digits is known.

    The unit of a column stands in brackets in its name, ``[1]`` for numbers without a dimension.
    """
    with (TABLES / f"{name}.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def not_yet() -> list[dict[str, str]]:
    """The published tables that no model answers: title, citation, and the missing physics."""
    found: list[dict[str, str]] = tomllib.loads((TABLES / "not_yet.toml").read_text(encoding="utf-8"))["table"]
    return found


def half_digit(printed: str) -> float:
    """Half a unit of the last printed digit.

    Examples
    --------
    >>> half_digit("0.025")
    0.0005
    """
    return 0.5 * 10.0 ** -len(printed.partition(".")[2])
