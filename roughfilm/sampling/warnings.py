"""Warnings about single windows, counted over all windows."""

import re
from collections import Counter
from collections.abc import Sequence


def counted(warnings: Sequence[Sequence[str]]) -> list[str]:
    """The warnings of several windows, each once with the number of windows that have it, the most frequent first.

    Sentences that differ in their numbers only are counted together; the first of them is given.

    Parameters
    ----------
    warnings : sentences about each window.

    Examples
    --------
    >>> counted([["gap 2.14 µm is small"], ["gap 1 µm is small"], []])
    ['2 of 3 windows: gap 2.14 µm is small']
    """
    counts = Counter(key for own in warnings for key in {_without_numbers(sentence) for sentence in own})
    first = {_without_numbers(sentence): sentence for own in reversed(warnings) for sentence in reversed(own)}
    return [f"{count} of {len(warnings)} windows: {first[key]}" for key, count in counts.most_common()]


def _without_numbers(sentence: str) -> str:
    return re.sub(r"[-.\d]+", "", sentence)
