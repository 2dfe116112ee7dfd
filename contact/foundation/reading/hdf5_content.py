"""The content of HDF5 files: a reader states what it takes, and everything is checked before and while it is read.

A file can be forged, with a right digest and a wrong content: datasets that claim more values than they hold, that are
compressed a million times, or that lie in other files. Sizes are checked against what the file holds before anything is
read. Then presence, type, shape and values are checked.
"""

import json
import math
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.reading.json_entries import from_json
from roughfilm.contact.foundation.reading.limits import memory_available

if TYPE_CHECKING:
    import h5py

EXPANSION = 1100
"""Largest number of bytes that one stored byte stands for: deflate reaches 1032."""

FREE_BYTES = 1 << 24
"""Number of bytes that a dataset may claim beyond what it stores, such as zeros that take no space."""

FILTERS = {1, 2}
"""Numbers of the HDF5 filters that datasets may have: deflate and shuffle."""

TYPES: Mapping[type, Any] = {float: np.float64, int: np.int64, bool: np.bool_}
"""Type of the numbers of an array by that of one number."""

HDF5_ERRORS = (OSError, LookupError, ValueError, TypeError, AttributeError, RuntimeError, MemoryError)
"""Errors with which h5py refuses damaged content."""


@dataclass(frozen=True, kw_only=True)
class Numbers:
    """Numbers in a dataset or an attribute.

    Attributes
    ----------
    shape : length along each dimension; a name stands for a length that is the same wherever the name is used, and
        None for any shape of one dimension or more.
    kind : the Python type of one number.
    missing : whether a number may be NaN.
    infinite : whether a number may be infinite.
    optional : whether all of it may be missing.
    """

    shape: tuple[int | str, ...] | None = ()
    kind: type[float | int | bool] = float
    missing: bool = False
    infinite: bool = False
    optional: bool = False


@dataclass(frozen=True, kw_only=True)
class Text:
    """A text in an attribute, or a column of texts in a dataset; parameters as in :class:`Numbers`."""

    shape: tuple[int | str, ...] = ()
    optional: bool = False


@dataclass(frozen=True, kw_only=True)
class Json:
    """JSON in an attribute: entries of a Python type ``kind``; ``missing`` and ``optional`` as in :class:`Numbers`."""

    kind: Any
    missing: bool = False
    optional: bool = False


Item = Numbers | Text | Json

Layout = Mapping[str, Item]
"""What a reader takes from a file, by name: "group/name" is a dataset, "group/name@attribute" an attribute, and
"@attribute" one of the file."""


@dataclass(frozen=True)
class Content:
    """An open HDF5 file whose content is checked when it is taken.

    Attributes
    ----------
    file : the open file.
    path : its path, for messages.
    remedy : the end of the error messages.
    """

    file: "h5py.File"
    path: Path
    remedy: str

    def take(self, layout: Layout) -> dict[str, Any]:
        """The values of a layout by name; None for an optional one that is missing.

        Raises
        ------
        InputError
            If one is missing, has another type or shape, is not finite, or claims more than the file holds.
        """
        lengths: dict[str, int] = {}
        known: dict[str, Any] = {}
        return {name: self._value(name, item, lengths, known) for name, item in layout.items()}

    def one(self, name: str, item: Item) -> Any:
        """The value of one name; errors are those of :meth:`take`."""
        return self.take({name: item})[name]

    def names(self, group: str) -> list[str]:
        """The names in a group, in their order; none if the group is missing."""
        with self._checked(group):
            place = self._object(group, {})
            return [] if place is None else list(place.keys())

    def holds(self, name: str) -> bool:
        """Whether there is a group or a dataset of this name."""
        with self._checked(name):
            return self._object(name, {}) is not None

    def fault(self, name: str, reason: str) -> InputError:
        """The error for content that is not as it must be."""
        return InputError(f"{self.path}: is damaged or incomplete ({name[:80]!r} {reason}); {self.remedy}")

    @contextmanager
    def _checked(self, name: str) -> Iterator[None]:
        """Raise InputError in place of the errors of h5py."""
        try:
            yield
        except HDF5_ERRORS as error:
            if isinstance(error, InputError):
                raise
            reason = " ".join(str(error).split())[:120]
            raise self.fault(name, f"cannot be read: {reason or type(error).__name__}") from error

    def _value(self, name: str, item: Item, lengths: dict[str, int], known: dict[str, Any]) -> Any:
        with self._checked(name):
            place, at, attribute = name.partition("@")
            owner = self._object(place, known)
            attributes: Any = owner.attrs if at and owner is not None else {}
            if owner is None or (at and attribute not in attributes):
                if item.optional:
                    return None
                raise self.fault(name, "is missing")
            stored = attributes.get_id(attribute) if at else self._bounded(name, owner)
            shape = stored.shape
            if shape is None:
                raise self.fault(name, "is empty")
            wanted = () if isinstance(item, Json) else item.shape
            if wanted is not None:
                self._check_shape(name, shape, wanted, lengths)
            elif not shape:
                raise self.fault(name, "has no dimension")
            if at and math.prod(shape) * stored.dtype.itemsize > FREE_BYTES:
                raise self.fault(name, f"claims {math.prod(shape)} values")
            if isinstance(item, Numbers):
                return self._numbers(name, item, stored, lambda: attributes[attribute] if at else owner[()])
            if not at:
                return self._texts(name, owner)
            text = attributes[attribute]
            if not isinstance(text, str):
                raise self.fault(name, "is no text")
            text.encode()
            if not isinstance(item, Json):
                return text
            value = from_json(text, item.kind)
            if not item.missing:
                json.dumps(json.loads(text), allow_nan=False)
            return value

    def _object(self, name: str, known: dict[str, Any]) -> Any:
        """The group or dataset of a name, "" for the file; None if there is none.

        Links to other places are refused: they may lead to other files or in a circle.

        Parameters
        ----------
        name : the name.
        known : the groups and datasets that were looked up before, to which those of this call are added.
        """
        if name not in known:
            known[name] = self._looked_up(name, known) if name else self.file
        return known[name]

    def _looked_up(self, name: str, known: dict[str, Any]) -> Any:
        import h5py  # slow to import

        group, _, part = name.rpartition("/")
        place = self._object(group, known)
        link = place.get(part, getlink=True) if isinstance(place, h5py.Group) else None
        if link is None:
            return None
        if not isinstance(link, h5py.HardLink):
            raise self.fault(name, "is a link")
        return place[part]

    def _bounded(self, name: str, dataset: Any) -> Any:
        """The dataset, after a check that it lies in this file and claims no more than the file can hold."""
        import h5py  # slow to import

        if not isinstance(dataset, h5py.Dataset):
            raise self.fault(name, "is no dataset")
        properties = dataset.id.get_create_plist()
        if properties.get_external_count() or properties.get_layout() == h5py.h5d.VIRTUAL:
            raise self.fault(name, "lies in another file")
        if not {properties.get_filter(number)[0] for number in range(properties.get_nfilters())} <= FILTERS:
            raise self.fault(name, "has an unknown filter")
        shape = dataset.shape or ()
        if dataset.chunks is not None and any(chunk > side for chunk, side in zip(dataset.chunks, shape, strict=True)):
            raise self.fault(name, f"has pieces of the shape {dataset.chunks!s:.60}")
        claimed = math.prod(shape) * dataset.dtype.itemsize
        stored = min(dataset.id.get_storage_size(), self.path.expanduser().stat().st_size)
        if claimed > EXPANSION * stored + FREE_BYTES:
            raise self.fault(name, f"claims {claimed:.3g} bytes, and {stored} are stored")
        if claimed > FREE_BYTES and claimed > (there := memory_available()):
            raise self.fault(name, f"claims {claimed:.3g} bytes, and {there:.3g} of memory are available")
        return dataset

    def _check_shape(
        self, name: str, shape: tuple[int, ...], wanted: tuple[int | str, ...], lengths: dict[str, int]
    ) -> None:
        known = len(shape) == len(wanted) and all(
            length == (lengths.setdefault(side, length) if isinstance(side, str) else side)
            for length, side in zip(shape, wanted, strict=True)
        )
        if not known:
            sides = ", ".join(str(lengths.get(side, side) if isinstance(side, str) else side) for side in wanted)
            raise self.fault(name, f"has the shape {shape!s:.60}, not ({sides})")

    def _numbers(self, name: str, item: Numbers, stored: Any, read: Callable[[], Any]) -> Any:
        dtype, kinds = stored.dtype, {float: "fiu", int: "iu", bool: "b"}[item.kind]
        if dtype.kind not in kinds or dtype.itemsize > 8:
            raise self.fault(name, f"has the type {dtype!s:.60}, not {item.kind.__name__}")
        values: NDArray[Any] = np.asarray(read(), dtype=TYPES[item.kind])
        if item.kind is float:
            if not item.missing and np.isnan(values).any():
                raise self.fault(name, "is not a number")
            if not item.infinite and np.isinf(values).any():
                raise self.fault(name, "is infinite")
        return values if stored.shape else values.item()

    def _texts(self, name: str, dataset: Any) -> list[str]:
        """The texts of a column, read in pieces: many entries can lead to one long text."""
        import h5py  # slow to import

        if h5py.check_string_dtype(dataset.dtype) is None:
            raise self.fault(name, f"has the type {dataset.dtype!s:.60}, not text")
        size = self.path.expanduser().stat().st_size
        step, texts, length = max(1, FREE_BYTES // size), list[str](), 0
        for low in range(0, dataset.shape[0], step):
            piece = dataset.asstr()[low : low + step].tolist()
            length += sum(map(len, piece))
            if length > EXPANSION * size + FREE_BYTES:
                raise self.fault(name, f"claims {length} characters")
            texts += piece
        return texts
