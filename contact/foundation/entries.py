"""Building blocks of tables in TOML files: numbers with units, and tables that refuse unknown keys."""

import math
import os
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Self

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field, GetCoreSchemaHandler
from pydantic_core import core_schema

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.ranges import RANGES
from roughfilm.contact.foundation.units import ZERO_CELSIUS, SiNumber, converted, to_si, with_unit

REMEDY = "make a changed scene with rf.replace, such as rf.replace(scene, 'geometry.depth', '7.5 um')"


class Part(BaseModel):
    """Base class of a table in a TOML file; it is immutable and refuses unknown keys."""

    model_config = ConfigDict(frozen=True, extra="forbid", defer_build=True)

    def model_copy(self, *, update: Mapping[str, Any] | None = None, deep: bool = False) -> Self:
        """A copy of this table with other values at some of its keys, which are not checked.

        Raises
        ------
        InputError
            If the table has no such key; :func:`roughfilm.replace` takes dotted keys and checks the values.
        """
        for name in (update or {}).keys() - type(self).model_fields:
            raise InputError(f"{name}: is no key of {type(self).__name__}; {REMEDY}")
        return super().model_copy(update=update, deep=deep)

    if not TYPE_CHECKING:  # a checker of types finds assignments to an immutable model without it

        def __setattr__(self, name: str, value: object) -> None:
            raise InputError(f"{name}: {type(self).__name__} is immutable; {REMEDY}")


def _positive(value: float) -> float:
    if not value > 0:
        raise ValueError(f"got {value!r}; it must be above zero")
    return value


def plain_number(value: object) -> float:
    """The dimensionless number as a float, also of a percentage such as "60 %".

    Raises
    ------
    ValueError
        For anything else, and for a number outside of the range of dimensionless numbers.
    """
    number = si_number(value)
    if number not in RANGES["1"]:
        raise ValueError(f"got {value!r:.60}; a dimensionless number must be 0 or {RANGES['1']} in size")
    return number


def rounded_number(value: object) -> float:
    """The dimensionless number as :func:`plain_number` gives it; one below the range is a rounding error, and zero."""
    return 0.0 if abs(si_number(value)) < RANGES["1"].least else plain_number(value)


def si_number(value: object) -> float:
    """The number as a float, which may be infinite or not a number; ValueError for anything else."""
    if isinstance(value, str) and value.rstrip().endswith("%"):
        return to_si(value, "%") / 100
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise ValueError(f"got {value!r:.60}; write a plain number, without unit or quotes{_unquoted(value)}")
    try:
        return float(value)
    except OverflowError:
        return math.inf if value > 0 else -math.inf


def _unquoted(value: object) -> str:
    """The number of a text that holds nothing else, as an example of how to write it."""
    number = value.strip().replace(",", ".") if isinstance(value, str) else ""
    return f": {number}" if re.fullmatch(r"[-+]?\d+(\.\d+)?(e[-+]?\d{1,3})?", number, re.IGNORECASE) else ""


@dataclass(frozen=True)
class InUnit:
    """Annotation of an SI number that is read from text with a unit and written back as such text.

    A number that ``in_si`` marks is read as one in the SI unit.

    Attributes
    ----------
    base : SI unit, such as "m".
    any_sign : whether zero and negative numbers are accepted; by default only positive ones are.
    rounds : whether a number below the range is a rounding error of a computed one, and zero.
    """

    base: str
    any_sign: bool = False
    rounds: bool = False

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> core_schema.CoreSchema:
        return core_schema.no_info_before_validator_function(
            self._number,
            handler(source),
            serialization=core_schema.plain_serializer_function_ser_schema(lambda value: with_unit(value, self.base)),
        )

    def _number(self, text: object) -> float:
        small = self.rounds and abs(converted(text, self.base)) < RANGES[self.base].least
        number = 0.0 if small else to_si(text, self.base)
        if number <= 0 and not self.any_sign:
            zero = f"absolute zero, {-ZERO_CELSIUS} degC" if self.base == "K" else "zero"
            got = f"{text:.6g} {self.base}" if isinstance(text, SiNumber) else f"{text!r:.60}"
            raise ValueError(f"got {got}; it must be above {zero}")
        return number


class FileText(str):
    """A text in a file of entries, which knows the folder of the file."""

    folder: Path


def in_folder(entry: Any, folder: Path) -> Any:
    """The entry with every text in it, also in tables and lists, marked as one in a file of this folder."""
    if isinstance(entry, dict):
        return {key: in_folder(value, folder) for key, value in entry.items()}
    if isinstance(entry, list):
        return [in_folder(value, folder) for value in entry]
    if not isinstance(entry, str):
        return entry
    text = FileText(entry)
    text.folder = folder
    return text


def file_name(entry: object) -> object:
    """The name of a file: one that :func:`in_folder` marks is relative to its folder, unless it begins with "~".

    ValueError if there is no such user.
    """
    if isinstance(entry, str) and entry.startswith("~"):
        if os.path.expanduser(entry) == entry:
            raise ValueError(f"got {entry!r:.60}, which leads nowhere; there is no such user")
        return str(entry)
    return str(entry.folder / entry) if isinstance(entry, FileText) else entry


@dataclass(frozen=True)
class NamesFile:
    """Annotation of an entry that is the name of a file, or may be one in place of a table.

    A serialisation with the context ``{"files": names}`` adds the name to the set ``names``.

    Attributes
    ----------
    words : texts that are no names of files.
    """

    words: tuple[str, ...] = ()

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> core_schema.CoreSchema:
        inner = handler(source)
        return core_schema.no_info_before_validator_function(
            self._named,
            inner,
            serialization=core_schema.wrap_serializer_function_ser_schema(self._noted, schema=inner, info_arg=True),
        )

    def _named(self, entry: object) -> object:
        return str(entry) if isinstance(entry, str) and entry in self.words else file_name(entry)

    def _noted(self, value: Any, serialize: Any, info: core_schema.SerializationInfo) -> Any:
        if isinstance(value, str) and value not in self.words and info.context and "files" in info.context:
            info.context["files"].add(value)
        return serialize(value)


def _pair(given: object) -> object:
    """The values along x and y; a single value is used for both."""
    values = given.split(",") if isinstance(given, str) else given if isinstance(given, list | tuple) else [given]
    if isinstance(given, str) and len(values) == 2 and re.fullmatch(r"\s*[-+]?\d+\s*", str(values[0])):
        first, second = map(str.strip, values)
        unit = re.sub(r"^[\d.]+\s*", "", second)
        raise ValueError(f"got {given!r:.60}, with a comma; write '{first}.{second}' or '{first} {unit}, {second}'")
    if not 1 <= len(values) <= 2:
        raise ValueError(f"got {given!r:.60}; write one length or two, such as '1 um' or ['1 um', '2 um']")
    return values[0], values[-1]


Length = Annotated[float, InUnit("m")]
LengthPair = Annotated[tuple[Length, Length], BeforeValidator(_pair)]
ScenePath = Annotated[str, Field(min_length=1), NamesFile()]
"""The name of a file."""

Coordinate = Annotated[float, InUnit("m", any_sign=True)]
Angle = Annotated[float, InUnit("rad", any_sign=True)]
PositiveNumber = Annotated[float, BeforeValidator(plain_number), AfterValidator(_positive)]
