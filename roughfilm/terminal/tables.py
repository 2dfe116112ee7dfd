"""Tables that fit the width of the terminal and its character set: no name is cut, no number is broken."""

from collections.abc import Sequence

from rich import box
from rich.cells import cell_len
from rich.console import Console, ConsoleOptions, RenderResult
from rich.table import Column, Table
from rich.text import Text

from roughfilm.terminal.layout import in_charset, visible, wrapped

GAP = 2
"""Spaces between two columns."""

TEXT_WIDTH = 24
"""Least width of a column of words, which may take several lines; narrower ones are printed below."""

RULED = box.Box("    \n    \n ── \n    \n    \n    \n    \n    \n")
RULED_IN_ASCII = box.Box("    \n    \n -- \n    \n    \n    \n    \n    \n", ascii=True)
"""A rule below the heads, and no other lines."""


class FittedTable(Table):
    """A table that keeps to the width of the terminal.

    Heads take several lines, and so do words in the columns after the first that are aligned to the left. Where this
    is not enough, the columns that have no room follow in a second table with the first column again. The caption
    stands below the last one.
    """

    def __init__(self, *, title: str | None = None) -> None:
        super().__init__(title=title, title_justify="left")

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        """Yield one table, or several below each other."""
        heads = [in_charset(_plain(console, column.header), console.encoding) for column in self.columns]
        cells = [
            [in_charset(_plain(console, cell), console.encoding) for cell in column.cells] for column in self.columns
        ]
        needs = [
            _need(head, column, own, first=not number)
            for number, (head, column, own) in enumerate(zip(heads, self.columns, cells, strict=True))
        ]
        width = options.max_width
        title = None if self.title is None else in_charset(_plain(console, self.title), console.encoding)
        if title is not None:
            yield Text(wrapped(title, width), style="italic")
        blocks = _blocks(needs, width)
        ruled = RULED if console.encoding.startswith("utf") else RULED_IN_ASCII
        for number, block in enumerate(blocks):
            if number:
                yield Text("")
            if len(block) == 2 and _total([needs[one] for one in block]) > width:
                name, other = block
                pairs = zip(cells[name], cells[other], strict=True)
                yield Text("\n".join(wrapped(f"{key}: {words}", width) for key, words in pairs))
                continue
            part = Table(box=ruled, show_edge=False, pad_edge=False, padding=(0, 0, 0, GAP - 1))
            yield self._filled(part, block, heads, cells, needs, width)
        if self.caption is not None:
            caption = in_charset(_plain(console, self.caption), console.encoding)
            yield Text("\n".join(wrapped(line, width) for line in caption.splitlines()))

    def _filled(
        self,
        part: Table,
        block: Sequence[int],
        heads: Sequence[str],
        cells: Sequence[Sequence[str]],
        needs: Sequence[int],
        width: int,
    ) -> Table:
        """A table that is filled with some of the columns."""
        wanted = [max(map(cell_len, (heads[one], *cells[one]))) for one in block]
        widths = _widths([needs[one] for one in block], wanted, width)
        for one, size in zip(block, widths, strict=True):
            part.add_column(Text(heads[one]), justify=self.columns[one].justify, width=size, overflow="fold")
        for number, row in enumerate(self.rows):
            part.add_row(*(Text(cells[one][number]) for one in block), style=row.style)
        return part


def _plain(console: Console, cell: object) -> str:
    text = cell if isinstance(cell, Text) else console.render_str(str(cell), highlight=False)
    return visible(text.plain)


def _longest_word(text: str) -> int:
    return max(map(cell_len, text.split()), default=0)


def _need(head: str, column: Column, cells: Sequence[str], *, first: bool) -> int:
    """The least width of a column: no word is broken, and no number or name takes two lines."""
    longest = max(map(cell_len, cells), default=0)
    if column.justify == "left" and not first:
        longest = max(*map(_longest_word, cells), min(longest, TEXT_WIDTH)) if cells else 0
    return max(longest, _longest_word(head), 1)


def _total(widths: Sequence[int]) -> int:
    return sum(widths) + GAP * (len(widths) - 1)


def _blocks(needs: Sequence[int], width: int) -> list[list[int]]:
    """The columns of each table below each other; the first column stands in all of them."""
    blocks = [[0]]
    for number in range(1, len(needs)):
        if len(blocks[-1]) > 1 and _total([needs[one] for one in (*blocks[-1], number)]) > width:
            blocks.append([0])
        blocks[-1].append(number)
    return blocks


def _widths(needs: Sequence[int], wanted: Sequence[int], width: int) -> list[int]:
    """The widths of the columns: what is left of the terminal goes to the column that takes the most lines."""
    widths = list(needs)
    while _total(widths) > width and widths[0] > TEXT_WIDTH // 2:  # nothing fits: names take two lines
        widths[0] -= 1
    for _ in range(width - _total(widths)):
        one = max(range(len(widths)), key=lambda one: wanted[one] / widths[one])
        if wanted[one] <= widths[one]:
            break
        widths[one] += 1
    return widths
