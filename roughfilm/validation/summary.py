"""What the comparison with published numbers amounts to: counts, worst and median differences, tables in Markdown."""

import textwrap
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from statistics import median
from typing import Any

from roughfilm.contact.foundation.rounding import share, with_error
from roughfilm.validation.published import Answer, Row, Source, Verdict

COLUMNS = ("source", "numbers", "within", "outside", "suspect", "median", "largest")
"""Columns of the table of all sources; the last two are relative differences."""


LINE = 120
"""Length of a line in Markdown."""

MIN_UNCERTAINTY = 1e-6
"""Uncertainty over the value below which it is not shown."""


@dataclass(frozen=True, kw_only=True)
class Compared:
    """A source with its answer, and when it was answered, on the finest grids or not, in how much CPU time, s."""

    source: Source
    answer: Answer
    created: str
    cpu_s: float
    thorough: bool

    @property
    def method(self) -> str:
        """The model and its resolution, in words."""
        return self.source.methods[self.thorough]

    def count(self, verdict: Verdict) -> int:
        """Number of rows with a verdict."""
        return sum(row.verdict == verdict for row in self.answer.rows)

    @property
    def differences(self) -> list[float]:
        """The relative differences, without signs, of all rows that have one."""
        return [abs(row.relative) for row in self.answer.rows if row.relative is not None]

    @property
    def worst(self) -> Row:
        """The row whose difference is the largest over what is allowed."""
        return max(self.answer.rows, key=lambda row: abs(row.difference) / row.allowed)

    @property
    def cells(self) -> tuple[str, ...]:
        """The row of the table of all sources, with the ``COLUMNS``."""
        return (
            self.source.name,
            str(len(self.answer.rows)),
            *(str(self.count(verdict)) for verdict in (Verdict.WITHIN, Verdict.OUTSIDE, Verdict.SUSPECT)),
            in_percent(median(self.differences)),
            in_percent(max(self.differences)),
        )


def in_percent(relative: float) -> str:
    """A relative difference in per cent, with two digits.

    Examples
    --------
    >>> in_percent(0.0123), in_percent(1.2e-9)
    ('1.2 %', '< 0.001 %')
    """
    return "< 0.001 %" if relative < 1e-5 else share(relative)


def ours_in_words(row: Row) -> str:
    """Our value with its uncertainty, or with six digits where that is smaller."""
    if row.uncertainty is not None and row.uncertainty < MIN_UNCERTAINTY * abs(row.ours):
        return f"{row.ours:.6g}"
    return with_error(row.ours, row.uncertainty)


def headline(compared: Sequence[Compared]) -> str:
    """The answer in a sentence."""
    rows = [row for one in compared for row in one.answer.rows]
    within, outside, suspect = (sum(row.verdict is verdict for row in rows) for verdict in Verdict)
    return (
        f"{within} of {len(rows)} published numbers lie within the bar of their source; {outside} lie outside, and "
        f"{suspect} more are contradicted by other published numbers or by a second method."
    )


def largest(compared: Sequence[Compared]) -> str:
    """The row that is the farthest outside of what is allowed, in a sentence."""
    one = max(compared, key=lambda each: abs(each.worst.difference) / each.worst.allowed)
    row = one.worst
    of_published = "" if row.relative is None else f", {100 * row.relative:+.2g} %"
    return (
        f"The farthest from its bar: {row.quantity}, {row.case} ({one.source.name}), {row.published:g} published and "
        f"{row.ours:.4g} ours{of_published}, {abs(row.difference) / row.allowed:.2g} times what is allowed."
    )


def entries_of(compared: Sequence[Compared]) -> dict[str, Any]:
    """The comparison as entries for JSON."""
    return {
        "headline": headline(compared),
        "sources": [
            {
                "name": one.source.name,
                "title": one.source.title,
                "citation": one.source.citation,
                "obtained": one.source.obtained,
                "method": one.method,
                "bar": one.source.bar,
                "created": one.created,
                "cpu_s": one.cpu_s,
                "remarks": list(one.answer.remarks),
                "rows": [
                    {
                        **asdict(row),
                        "relative_difference": row.relative,
                        "allowed": row.allowed,
                        "verdict": row.verdict.value,
                    }
                    for row in one.answer.rows
                ],
                "studies": [asdict(study) for study in one.answer.studies],
            }
            for one in compared
        ],
    }


def in_markdown(compared: Sequence[Compared]) -> str:
    """The table of all sources, and the remarks and studies of each, in Markdown with lines of at most ``LINE``."""
    parts = [_filled(f"{headline(compared)} {largest(compared)}"), table(COLUMNS, [one.cells for one in compared])]
    for one in compared:
        parts += [
            f"### {one.source.title}",
            _filled(f"{one.source.citation}. {one.source.obtained}"),
            _filled(f"Bar: {one.source.bar}. Ours: {one.method}."),
            *map(_filled, one.answer.remarks),
        ]
        parts += [f"{study.title}:\n\n{table(study.columns, study.cells)}" for study in one.answer.studies]
    return "\n\n".join(parts) + "\n"


def _filled(text: str) -> str:
    return textwrap.fill(text, LINE, break_long_words=False, break_on_hyphens=False)


def table(columns: Sequence[str], cells: Sequence[Sequence[str]]) -> str:
    """A table in Markdown."""
    lines = [columns, ["---"] * len(columns), *cells]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)
