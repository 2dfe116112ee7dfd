"""The line of each key in the text of a TOML file, for messages."""

import re
from collections.abc import Mapping, Sequence
from itertools import count

Location = Sequence[int | str]
"""The location of an entry: the keys and list indices that lead to it, from the outermost."""

_NAME = r"""(?:[A-Za-z0-9_-]+|"[^"]*"|'[^']*')"""
_DOTTED = rf"{_NAME}(?:\s*\.\s*{_NAME})*"
_HEADER = re.compile(rf"\s*(\[\[?)\s*({_DOTTED})\s*\]")
_KEY = re.compile(rf"\s*({_DOTTED})\s*=")
_TEXT_OR_COMMENT = re.compile(r""""(?:[^"\\]|\\.)*"|'[^']*'|#.*""")
_LONG_QUOTES = re.compile(r"\"\"\"|\'\'\'")


def key_lines(text: str) -> Mapping[tuple[int | str, ...], int]:
    r"""The line, from 1, of each table and each key, by its location; keys of tables in one line are left out.

    Examples
    --------
    >>> dict(key_lines('kind = "pocket"\n[motion]\nspeed = "1 m/s"'))
    {('kind',): 1, ('motion',): 2, ('motion', 'speed'): 3}
    """
    found: dict[tuple[int | str, ...], int] = {}
    table: tuple[int | str, ...] = ()
    quotes, depth = "", 0
    for number, line in enumerate(text.splitlines(), 1):
        if quotes:
            quotes = "" if quotes in line else quotes
            continue
        if not depth:
            if header := _HEADER.match(line):
                table = _inside(_names(header[2]), found)
                if header[1] == "[[":
                    found.setdefault(table, number)
                    table = (*table, next(place for place in count() if (*table, place) not in found))
                found[table] = number
                continue
            if key := _KEY.match(line):
                found.setdefault((*table, *_names(key[1])), number)
        marks = _LONG_QUOTES.findall(line)
        quotes = marks[0] if len(marks) % 2 else ""
        bare = _TEXT_OR_COMMENT.sub("", line)
        depth = max(depth + sum(map(bare.count, "[{")) - sum(map(bare.count, "]}")), 0)
    return found


def line_of(location: Location, lines: Mapping[tuple[int | str, ...], int]) -> int | None:
    """The line of an entry, or of the innermost table around it that has one; None if there is none."""
    around = (tuple(location[:length]) for length in range(len(location), 0, -1))
    return next((lines[place] for place in around if place in lines), None)


def _names(dotted: str) -> tuple[str, ...]:
    return tuple(name.strip("\"'") for name in re.findall(_NAME, dotted))


def _inside(names: Sequence[str], found: Mapping[tuple[int | str, ...], int]) -> tuple[int | str, ...]:
    """The location of a table whose header lists these names; in lists of tables it is inside the last one."""
    location: tuple[int | str, ...] = ()
    for name in names[:-1]:
        location = (*location, name)
        last = next(place for place in count() if (*location, place) not in found) - 1
        location = location if last < 0 else (*location, last)
    return (*location, *names[-1:])
