"""JSON text read as the entries of a Python type: every entry is there and has its type."""

from collections.abc import Hashable
from functools import cache
from typing import TYPE_CHECKING, Any, TypeVar, cast

if TYPE_CHECKING:
    from pydantic import TypeAdapter

T = TypeVar("T")


def from_json(text: str | bytes, kind: type[T]) -> T:
    """The value of a type, such as ``dict[str, float]`` or a dataclass, from JSON text.

    Raises
    ------
    ValueError
        If the text is not JSON, is nested too deeply, or an entry is missing or has another type; the message is one
        line that names the entry.

    Examples
    --------
    >>> from_json('{"depth": 1.5}', dict[str, float])
    {'depth': 1.5}
    """
    from pydantic import ValidationError  # slow to import

    adapter = _adapter(cast(Hashable, kind))
    try:
        value: T = adapter.validate_json(text)
    except ValidationError as error:
        fault = error.errors(include_url=False, include_input=False)[0]
        place = ".".join(map(str, fault["loc"]))[:80]
        raise ValueError(f"{place}: {fault['msg']}" if place else str(fault["msg"])) from None
    return value


@cache
def _adapter(kind: Hashable) -> "TypeAdapter[Any]":
    from pydantic import TypeAdapter  # slow to import

    return TypeAdapter(cast(Any, kind))
