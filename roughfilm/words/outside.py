"""Results and series outside the range of their model, in words."""

from collections.abc import Callable, Sequence


def outside_in_words(reasons: Sequence[str]) -> str:
    """The ways in which a result is outside the range of its model, in one line; "" if there are none.

    Examples
    --------
    >>> outside_in_words(["Re = 2000 exceeds 1440"])
    'outside the range of the model: Re = 2000 exceeds 1440; error unknown'
    """
    return f"outside the range of the model: {'; '.join(reasons)}; error unknown" if reasons else ""


def outside_of_series(
    points: Sequence[tuple[str, Sequence[str]]], words: Callable[[Sequence[str]], str] = outside_in_words
) -> str:
    """Which points of a series are outside the range of the model, with the reasons of the last one; "" without any.

    Parameters
    ----------
    points : the place of each point in words, such as "3000 rpm", and its reasons.
    words : words(reasons), the reasons of one point in a line.

    Examples
    --------
    >>> outside_of_series([("1 m/s", []), ("2 m/s", ["Re = 2000 exceeds 1440"])])
    'outside the range of the model: Re = 2000 exceeds 1440; error unknown, at 1 of 2 points: 2 m/s'
    """
    beyond = [(place, reasons) for place, reasons in points if reasons]
    if not beyond:
        return ""
    first, last = beyond[0][0], beyond[-1][0]
    where = first if len(beyond) == 1 else f"from {first} to {last}"
    return f"{words(beyond[-1][1])}, at {len(beyond)} of {len(points)} points: {where}"
