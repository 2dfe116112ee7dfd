"""The cost of a result in words: the solution, and what later runs do not pay again."""

from collections.abc import Mapping

from roughfilm.rom.ladder.result import Numerics

SHOWN_S = 0.1
"""CPU time below which a one-time cost is not shown, s."""

NAMES = {
    "table": "for the table of the surface, kept",
    "compilation": "compilation, once per installation",
    "surface": "to read or make the surface",
    "start": "to load compiled kernels",
}
"""The words for each one-time cost."""


def cost_in_words(numerics: Numerics) -> str:
    """The CPU time of a result with its one-time costs, such as "2.7 CPU s (+ 187 s for the table of ..., kept)"."""
    return f"{numerics.cpu_s:.3g} CPU s{one_time_in_words(numerics.one_time)}"


def one_time_in_words(one_time: Mapping[str, float]) -> str:
    """The one-time costs in parentheses, behind a blank; "" if there are none worth a word.

    Examples
    --------
    >>> one_time_in_words({"table": 187.2, "compilation": 4.0, "surface": 0.01})
    ' (+ 187 s for the table of the surface, kept; + 4 s compilation, once per installation)'
    """
    parts = [f"+ {spent:.3g} s {NAMES.get(name, name)}" for name, spent in one_time.items() if spent >= SHOWN_S]
    return f" ({'; '.join(parts)})" if parts else ""
