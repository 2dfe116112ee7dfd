"""The cost of a result in words: the solution, and what later runs do not pay again."""

from collections.abc import Mapping

from roughfilm.rom.ladder.result import Result

SHOWN_S = 0.1
"""CPU time below which a one-time cost is not shown, s."""

NAMES = {
    "table": "for the table of the surface",
    "compilation": "compilation, once per installation",
    "surface": "to read or make the surface",
    "start": "to load the program",
    "errors": "for the error of the model",
}
"""The words for each one-time cost."""


def seconds(time: float) -> str:
    """A time of computation with two digits, in ms below 0.1 s.

    Examples
    --------
    >>> seconds(0.0254), seconds(2.54)
    ('25 ms', '2.5 s')
    """
    return f"{time * 1e3:.2g} ms" if time < 0.1 else f"{time:.2g} s"


def cost_in_words(result: Result) -> str:
    """The CPU time of a result with its one-time costs, such as "2.7 CPU s (+ 187 s for the table of ..., kept)"."""
    stored = bool(result.provenance.get("table", {}).get("stored"))
    return f"{result.numerics.cpu_s:.3g} CPU s{one_time_in_words(result.numerics.one_time, stored=stored)}"


def one_time_in_words(one_time: Mapping[str, float], *, stored: bool) -> str:
    """The one-time costs in parentheses, behind a blank; "" if there are none worth a word.

    ``stored`` is whether the table is kept for later runs.

    Examples
    --------
    >>> one_time_in_words({"table": 187.2, "compilation": 4.0, "surface": 0.01}, stored=True)
    ' (+ 187 s for the table of the surface, kept; + 4 s compilation, once per installation)'
    """
    ends = {"table": ", kept" if stored else ""}
    parts = [
        f"+ {spent:.3g} s {NAMES.get(name, name)}{ends.get(name, '')}"
        for name, spent in one_time.items()
        if spent >= SHOWN_S
    ]
    return f" ({'; '.join(parts)})" if parts else ""
