"""Scene files with mistakes, made by seed from the examples: values, units, types, keys and bytes that are wrong."""

import contextlib
import copy
import datetime
import json
import random
import tomllib
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from typing import Any

from places import SCENES

from roughfilm.contact.foundation.ranges import RANGES
from roughfilm.contact.foundation.units import to_si

SURFACE = {
    "kind": "self_affine",
    "size": ["40 um", "40 um"],
    "points": [16, 16],
    "seed": 20071,
    "hurst": 0.8,
    "roll_off": "20 um",
    "cut_off": "10 um",
    "rms_height": "0.1 um",
}
"""A surface that every model of a contact solves in a moment."""

SMALL_CELL = {"size": ["0.3 mm", "0.3 mm"], "points": [16, 16]}
"""Changes of the rough walls of bearings."""

Entries = dict[str, Any]
Way = tuple[str | int, ...]


class Word(str):
    """Text that stands in a file as it is, without quotes."""

    __slots__ = ()


@cache
def examples() -> Mapping[str, Entries]:
    """The entries of every example, with surfaces of few points; a mutation changes a copy."""
    scenes: dict[str, Entries] = {}
    for path in sorted(SCENES.glob("*.toml")):
        entries = tomllib.loads(path.read_text(encoding="utf-8"))
        if "kind" not in entries or "name" not in entries:
            continue
        geometry, roughness = entries["geometry"], entries.get("roughness", {})
        if str(geometry.get("surface", "")).endswith(".toml"):
            geometry["surface"] = SURFACE
        elif isinstance(geometry.get("surface"), dict):
            geometry["surface"] |= {"points": [16, 16], "cut_off": "12.5 um"}
        if "surface" in roughness:
            roughness["surface"] |= SMALL_CELL | {"correlation_length": "0.1 mm"}
            roughness["surface"].pop("anisotropy", None)
        scenes[path.stem] = entries
    return scenes


def in_toml(value: Any) -> str:
    """The text of a value in a TOML file, also of values that no scene should hold."""
    if isinstance(value, Word):
        return str(value)
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(key)} = {in_toml(one)}" for key, one in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(in_toml, value)) + "]"
    if isinstance(value, datetime.date):
        return value.isoformat()
    return json.dumps(value).replace("\x7f", "\\u007f") if isinstance(value, str) else repr(value)


def as_file(entries: Entries) -> str:
    """The text of a scene file, a line for each entry outside of all tables."""
    return "".join(f"{json.dumps(key)} = {in_toml(value)}\n" for key, value in entries.items())


def ways(entries: Any, way: Way = ()) -> Iterator[Way]:
    """The places of all tables, lists and values, from the outside in."""
    if way:
        yield way
    inner = entries.items() if isinstance(entries, dict) else enumerate(entries) if isinstance(entries, list) else ()
    for key, value in inner:
        yield from ways(value, (*way, key))


def at(entries: Any, way: Way) -> Any:
    """The entry at a place."""
    for key in way:
        entries = entries[key]
    return entries


def set_at(entries: Any, way: Way, value: Any) -> None:
    """Put a value at a place."""
    at(entries, way[:-1])[way[-1]] = value


def _number(text: Any) -> tuple[float, str] | None:
    """The number and the rest of a text such as "30 um" or of a plain number; None for anything else."""
    if isinstance(text, bool):
        return None
    if isinstance(text, int | float):
        return float(text), ""
    head, _, unit = text.partition(" ") if isinstance(text, str) else ("", "", "")
    with contextlib.suppress(ValueError):
        return float(head), unit
    return None


def _numbers(entries: Entries) -> list[Way]:
    return [way for way in ways(entries) if _number(at(entries, way)) is not None]


def _with_number(entries: Entries, way: Way, number: Any) -> None:
    old = at(entries, way)
    unit = _number(old)[1]  # type: ignore[index]
    whole = isinstance(old, int) and isinstance(number, float) and number == number and abs(number) < 1e300
    plain = Word(str(int(number))) if whole else Word(str(number).replace("+", ""))
    set_at(entries, way, f"{number} {unit}" if isinstance(old, str) else plain)


DECADES = (1, 1, 2, 2, 3, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 14, 16, 18, 20, 40)
"""Powers of ten by which numbers are scaled."""


def scaled(entries: Entries, chance: random.Random) -> str:
    """Multiply a number by up to 40 powers of ten."""
    way = chance.choice(_numbers(entries))
    decades = chance.choice([-1, 1]) * chance.choice(DECADES)
    old = _number(at(entries, way))
    assert old is not None
    _with_number(entries, way, float(f"{old[0] * 10.0**decades:.6g}"))
    return f"{_dotted(way)} × 1e{decades}"


EXTREMES = (
    0, -1, 1, 2, -0.0, 1e-22, 1e13, 1e15, 1e16, 1e-16, 1e22, 1e-13, 1e300, 1e308, -1e308, 1e-300, 1e-308, 5e-324,
    10**9, 10**18, 10**30, -(10**9), float("nan"), float("inf"), float("-inf"), 0.5, 0.999999999999, 1.000000000001,
)  # fmt: skip


def extreme(entries: Entries, chance: random.Random) -> str:
    """Put an extreme number in the place of a number."""
    way, number = chance.choice(_numbers(entries)), chance.choice(EXTREMES)
    _with_number(entries, way, number)
    return f"{_dotted(way)} = {number}"


def at_the_end(entries: Entries, chance: random.Random) -> str:
    """Put the smallest or largest allowed number of its dimension in the place of a number, or one just beyond."""
    way = chance.choice(_numbers(entries))
    unit = _number(at(entries, way))[1]  # type: ignore[index]
    fitting = ["1"] if not unit else []
    for base in RANGES:
        with contextlib.suppress(ValueError):
            to_si(f"1 {unit}", base)
            fitting.append(base)
    base = (fitting or ["1"])[0]
    number = chance.choice([RANGES[base].least, RANGES[base].most]) * chance.choice([1.0, 1.0, 0.5, 2.0])
    set_at(entries, way, f"{number} {base}" if unit else Word(str(number).replace("+", "")))
    return f"{_dotted(way)} = {number} {base}"


def negated(entries: Entries, chance: random.Random) -> str:
    """Change the sign of a number."""
    way = chance.choice(_numbers(entries))
    _with_number(entries, way, -_number(at(entries, way))[0])  # type: ignore[index]
    return f"{_dotted(way)} negated"


UNITS = (
    "m", "um", "Pa", "MPa", "Pa*s", "kg/m^3", "m/s", "rpm", "N", "N/m", "cSt", "%", "degC", "K", "1/GPa", "Pa/m", "rad",
    "", "furlong", "m^99", "m^-1", "um um", "**", "m/0", "1e9", "'", "\u202e", "µ", "μm", "MM", "()", "[m]", "{}", "\\",
)  # fmt: skip


def other_unit(entries: Entries, chance: random.Random) -> str:
    """Give a number another unit."""
    way, unit = chance.choice(_numbers(entries)), chance.choice(UNITS)
    set_at(entries, way, f"{_number(at(entries, way))[0]:g} {unit}")  # type: ignore[index]
    return f"{_dotted(way)} in {unit!r}"


OTHERS: tuple[Any, ...] = (
    True, False, [], {}, "", " ", [1, 2], ["1 um", "2 um"], [[1, 2], [3, 4]], [[]], {"a": 1}, {"kind": "gaussian"},
    datetime.date(2020, 2, 2), datetime.datetime(2020, 2, 2, 2, 2), "x" * 100_000, "1" * 100_000 + " um",
    "\x1b[31m red", "line\nline", "nul\x00", "..", "/", "/dev/zero", "/dev/full", "/proc/self/mem", "~nobody/none.toml",
    "no.toml", "a.h5", "b.npy", "c.csv", "--help", "%s%n", "{0.__class__}", "$HOME", "☃", "1 um; 2 um", Word("1e5"),
    Word("0x7fffffffffffffff"), Word("nan"), Word("-inf"), Word("1e999"), Word("9" * 500),
)  # fmt: skip


def other_type(entries: Entries, chance: random.Random) -> str:
    """Put a value of another type in the place of a value or a table."""
    way, value = chance.choice([*ways(entries)]), copy.deepcopy(chance.choice(OTHERS))
    set_at(entries, way, value)
    return f"{_dotted(way)} = {value!r:.40}"


def deleted(entries: Entries, chance: random.Random) -> str:
    """Delete a key, a table or an element of a list."""
    way = chance.choice([*ways(entries)])
    del at(entries, way[:-1])[way[-1]]
    return f"{_dotted(way)} deleted"


def added(entries: Entries, chance: random.Random) -> str:
    """Add an unknown key, or one that belongs to another table, to a table."""
    tables = [(), *(way for way in ways(entries) if isinstance(at(entries, way), dict))]
    way = chance.choice(tables)
    known = {way[-1] for scene in examples().values() for way in ways(scene) if isinstance(way[-1], str)}
    name = chance.choice([*sorted(known), "", "x" * 10_000, "lenght", "a.b", "__class__", "\u202e", "\x1b[2J"])
    at(entries, way)[name] = copy.deepcopy(chance.choice([*OTHERS[:12], "1 um", 1, 0.5]))
    return f"{_dotted((*way, name))!r:.40} added"


def swapped(entries: Entries, chance: random.Random) -> str:
    """Exchange two values."""
    first, second = (chance.choice(_numbers(entries)) for _ in range(2))
    one, other = at(entries, first), at(entries, second)
    set_at(entries, first, other)
    set_at(entries, second, one)
    return f"{_dotted(first)} and {_dotted(second)} exchanged"


def counted(entries: Entries, chance: random.Random) -> str:
    """Change a whole number."""
    wholes = [way for way in ways(entries) if type(at(entries, way)) is int]
    if not wholes:
        return scaled(entries, chance)
    way = chance.choice(wholes)
    number = chance.choice([0, 1, 2, 3, 7, 17, 64, 1000, 10**5, 10**9, 2**63, 2**64, 10**40])
    set_at(entries, way, number)
    return f"{_dotted(way)} = {number}"


def other_word(entries: Entries, chance: random.Random) -> str:
    """Choose another of the words that scenes use, such as a shape or a law."""
    texts = [way for way in ways(entries) if isinstance(at(entries, way), str) and _number(at(entries, way)) is None]
    known = sorted({at(one, way) for one in examples().values() for way in ways(one) if isinstance(at(one, way), str)})
    way, word = chance.choice(texts), chance.choice(known)
    set_at(entries, way, word)
    return f"{_dotted(way)} = {word!r}"


OF_ENTRIES: tuple[Callable[[Entries, random.Random], str], ...] = (
    scaled, scaled, extreme, negated, other_unit, other_type, deleted, added, swapped, counted, other_word, at_the_end,
)  # fmt: skip
"""The mutations of entries."""

NUMBERS = (scaled, scaled, scaled, at_the_end)
"""Mutations that leave most scenes valid; the more frequent ones stand more than once."""


def duplicated(text: str, chance: random.Random) -> tuple[str, str]:
    """Repeat a line."""
    line = chance.choice(text.splitlines())
    return text + line + "\n", f"line {line!r:.40} twice"


def cut(text: str, chance: random.Random) -> tuple[str, str]:
    """End the file in the middle."""
    end = chance.randrange(len(text))
    return text[:end], f"cut at {end}"


def sprinkled(text: str, chance: random.Random) -> tuple[str, str]:
    """Put a strange character somewhere."""
    place = chance.randrange(len(text))
    sign = chance.choice('\x00\x1b\x7f\r\n"=[}#\ufeff\u2028“\\.')
    return text[:place] + sign + text[place:], f"{sign!r} at {place}"


def _dotted(way: Way) -> str:
    return ".".join(map(str, way))


def mutated(seed: int) -> tuple[str, tuple[str, ...], bytes]:
    """The name of the example, the mutations in words and the bytes of the file of a seed."""
    chance = random.Random(seed)
    name, entries = chance.choice([*examples().items()])
    entries = copy.deepcopy(entries)
    words = []
    kinds = NUMBERS if chance.random() < 0.5 else OF_ENTRIES
    for _ in range(chance.choice([1, 1, 2])):
        with contextlib.suppress(IndexError):  # nothing of that type is left
            words.append(chance.choice(kinds)(entries, chance))
    text = as_file(entries)
    if text and chance.random() < 0.06:
        text, word = chance.choice([duplicated, cut, sprinkled])(text, chance)
        words.append(word)
    data = text.encode("utf-8", "surrogatepass")
    if chance.random() < 0.01:
        data = data[: len(data) // 2] + b"\xff\xfe" + data[len(data) // 2 :]
        words.append("bytes that are not UTF-8")
    return name, tuple(words), data
