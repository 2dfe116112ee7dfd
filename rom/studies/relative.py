"""Conversion of lengths that are multiples of other lengths in their table ("0.3 width") to lengths with units."""

import re
from collections.abc import Mapping
from decimal import Decimal
from typing import Any

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.units import is_unit

_MULTIPLE = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d{1,3})?)\s*([A-Za-z_]\w*)\s*")


def resolve_relative(
    table: Mapping[str, Any], place: str, enclosing: Mapping[str, Any] | None = None
) -> dict[str, Any]:
    """The table in which every multiple of a key is replaced by a length in the unit of that key.

    The multiplication is decimal, so that "0.15 length" of "1 mm" is exactly "0.15 mm". In a list of tables each
    table may use its own keys and those of the enclosing table.

    Parameters
    ----------
    table : the entries of a table.
    place : dotted name of the table, for messages.
    enclosing : the entries of the enclosing table.

    Raises
    ------
    InputError
        If a word is neither a unit nor a key, a key is not a length, or multiples refer to each other in a circle.

    Examples
    --------
    >>> resolve_relative({"length": "2 mm", "width": "0.15 length", "shift": "-0.5 width"}, "geometry")
    {'length': '2 mm', 'width': '0.30 mm', 'shift': '-0.150 mm'}
    """
    known = {**(enclosing or {}), **table}

    def length(key: str, seen: tuple[str, ...]) -> str:
        text = known[key]
        match = _MULTIPLE.fullmatch(text) if isinstance(text, str) else None
        if match is None:
            raise InputError(f"{place}.{seen[-1]}: is a multiple of {key}, which is {text!r}; it must be a length")
        number, word = match.groups()
        if word not in known:
            if not is_unit(word):
                keys = ", ".join(sorted(known))
                raise InputError(f"{place}.{key}: got {text!r}; {word!r} is neither a unit nor one of the keys {keys}")
            return str(text)
        if word in (key, *seen):
            circle = " -> ".join([*seen, key, word])
            raise InputError(f"{place}.{key}: got {text!r}, which leads in a circle ({circle}); give one with a unit")
        other = _MULTIPLE.fullmatch(length(word, (*seen, key)))
        assert other is not None
        return f"{Decimal(number) * Decimal(other[1])} {other[2]}"

    flat = {
        key: length(key, ()) if isinstance(value, str) and _MULTIPLE.fullmatch(value) else value
        for key, value in table.items()
    }
    return {
        key: [
            resolve_relative(item, f"{place}.{key}.{i}", flat) if isinstance(item, Mapping) else item
            for i, item in enumerate(value)
        ]
        if isinstance(value, list)
        else value
        for key, value in flat.items()
    }
