"""Results on the terminal: one JSON object, or tables and lines; reused results and warnings on standard error."""

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from rich.markup import escape
from rich.table import Table

from roughfilm.rom.ladder.kind import kind_of
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.rom.ladder.result import Result
from roughfilm.terminal.console import messages, output, print_json, print_message
from roughfilm.terminal.layout import wrapped
from roughfilm.terminal.tables import FittedTable
from roughfilm.words.units import EXACT, UNKNOWN, in_engineering_units


def table_of(heads: Sequence[str], rows: Iterable[Sequence[str]], *, title: str | None = None, left: int = 0) -> Table:
    """A table of texts whose first ``left`` columns are aligned to the left and the others to the right."""
    table = FittedTable(title=None if title is None else escape(title))
    for number, head in enumerate(heads):
        table.add_column(head, justify="left" if number < left else "right")
    for row in rows:
        table.add_row(*map(escape, row))
    return table


def quantity_table(result: Result) -> Table:
    """The quantities of a result, those first that are sought most, in units of engineers, with their uncertainties.

    Below it stand remarks, such as for which part of the bearing the quantities hold.
    """
    kind = kind_of(result)
    texts = in_engineering_units(result.quantities)
    rows = [(title, *texts[name]) for name, title in kind.listed(result).items()]
    known = any(row[2] not in (EXACT, UNKNOWN) for row in rows)
    shown = rows if known else [(title, value, unit) for title, value, _, unit in rows]
    heads = ("quantity", "value", *(["±"] if known else []), "unit")
    table = table_of(heads, shown, title=f"{result.provenance['scene']['name']} by {result.model}", left=1)
    table.columns[-1].justify = "left"
    lines = list(kind.remarks(result.provenance["scene"], result.quantities))
    if not known:
        lines.append("uncertainties: unknown")
    table.caption = escape("\n".join(lines)) or None
    return table


def origin(sources: Iterable[str], warnings: Iterable[str], **inputs: Any) -> dict[str, Any]:
    """The provenance of a result: its inputs, warnings and sources, and the circumstances of the run."""
    return {**inputs, "warnings": list(warnings), "sources": list(sources), **circumstances()}


def show_result(
    entries: Mapping[str, Any], shown: Iterable[Table | str], *, as_json: bool, reused: str = "", summary: str = ""
) -> None:
    """Print the entries as JSON, or tables and lines; then how much was used again, all warnings, and the summary.

    Parameters
    ----------
    entries : the object of ``--json``, with its warnings under "provenance".
    shown : tables and lines for people; taken only without ``as_json``.
    reused : what "numerics" counts, such as "loads", of which it holds the reused ones as "loads_found".
    summary : the last line: the answer, and the files that are written; not printed with ``as_json``.
    """
    if as_json:
        print_json(dict(entries))
    else:
        print_all(shown)
    known = entries["numerics"].get(f"{reused}_found")
    if known:
        total = entries["numerics"][reused]
        line = f"{known} of {total} {reused} were solved before and are used again"
        messages.print(wrapped(line, messages.width), soft_wrap=True)
    for warning in entries["provenance"]["warnings"]:
        print_message("warning", warning)
    if summary and not as_json:
        print_all([summary])


def print_all(shown: Iterable[Table | str]) -> None:
    """Print tables, each with a free line below, and lines, which are broken between words only; no markup is read."""
    for one in shown:
        if isinstance(one, str):
            output.print(wrapped(one, output.width), soft_wrap=True, markup=False)
        else:
            output.print(one, "")


def written(answer: str, *paths: Path | None) -> str:
    """The last line of a command: the answer, and the files that are written.

    >>> written("1 load", Path("c.h5"), None)
    '1 load; written: c.h5'
    """
    places = ", ".join(str(path) for path in paths if path is not None)
    return f"{answer}; written: {places}" if places else answer


def print_left_out(reasons: Mapping[str, str]) -> None:
    """Print on standard error what was left out, and why."""
    for name, reason in reasons.items():
        print_message("left out", f"{name}: {reason}")
