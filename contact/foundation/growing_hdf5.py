"""HDF5 files that grow: arrays are added in place, and arrays written before are neither copied nor read for that.

A file has three parts: a header of 512 bytes, which the HDF5 format allows as a user block, the HDF5 data, and an
index. The header holds a mark, the SHA-256 digest of the index and its place. The index lists the arrays, which never
change, with place and CRC-32 checksum, and holds the SHA-256 digest of all other bytes of the HDF5 data. A file is
refused before it is opened if these other bytes or the arrays asked for were damaged: a damaged file can crash or hang
the HDF5 library.

Before HDF5 changes a file, everything but the arrays is saved in an undo file beside it, which is removed when the new
header is on disk. If a writer was killed meanwhile, the next reader or writer restores the file as it was before.
"""

import fcntl
import hashlib
import io
import json
import os
import zlib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO, TypeVar

import numpy as np
from pydantic import NonNegativeInt

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.checked_hdf5 import CHUNK_BYTES, HEADER_BYTES, marked
from roughfilm.contact.foundation.errors import InputError, unwritable
from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.reading.json_entries import from_json
from roughfilm.contact.foundation.reading.regular import holds_data
from roughfilm.contact.foundation.writing.scratch import is_at, scratch_directory

if TYPE_CHECKING:
    import h5py

T = TypeVar("T")


@dataclass(frozen=True)
class Block:
    """Place of an array in the file, bytes, and its CRC-32 checksum."""

    offset: int
    length: int
    checksum: int


@dataclass(frozen=True)
class Index:
    """Contents of a file: its blocks by the name of their dataset, the end of the HDF5 data, and what else it holds.

    ``rest`` is the SHA-256 digest of the bytes between header and end that belong to no block.
    """

    blocks: dict[str, Block]
    end: int
    rest: str


@dataclass(frozen=True, kw_only=True)
class IndexEntries:
    """The text of an index: offset, length and checksum of each block, and ``end`` and ``rest`` as in `Index`."""

    blocks: Mapping[str, tuple[NonNegativeInt, NonNegativeInt, int]]
    end: NonNegativeInt
    rest: str


@dataclass(frozen=True, kw_only=True)
class UndoEntries:
    """The first line of an undo file: inode and size of its file, and the places of the pieces that follow, bytes."""

    inode: int
    size: NonNegativeInt
    places: Sequence[tuple[NonNegativeInt, NonNegativeInt]]


class Writer:
    """An open HDF5 file to which arrays are added.

    Attributes
    ----------
    file : the HDF5 file; attributes and small datasets are written directly.
    """

    def __init__(self, file: "h5py.File", blocks: dict[str, Block]) -> None:
        self.file = file
        self._blocks = blocks

    def write(self, name: str, values: Array, unit: str) -> None:
        """Add an array as a dataset; an array of zeros takes no space."""
        dataset = self.file.create_dataset(name, shape=values.shape, dtype=values.dtype)
        dataset.attrs["unit"] = unit
        if values.flat[0] or values.any():
            data = np.ascontiguousarray(values)
            dataset[...] = data
            place = dataset.id.get_offset()
            self._blocks[dataset.name] = Block(place, data.nbytes, zlib.crc32(data.reshape(-1).data))

    def remove(self, name: str) -> None:
        """Remove a group. Nothing may be written after it: the undo file lacks arrays, whose place HDF5 uses again."""
        del self.file[name]
        for block in [block for block in self._blocks if block.startswith(f"/{name}/")]:
            del self._blocks[block]

    def rename(self, name: str, new: str) -> None:
        """Give a group another name."""
        self.file.move(name, new)
        for block in [block for block in self._blocks if block.startswith(f"/{name}/")]:
            self._blocks[f"/{new}{block.removeprefix(f'/{name}')}"] = self._blocks.pop(block)


def grow(path: Path, mark: bytes, remedy: str, fill: Callable[[Writer], None]) -> None:
    """Add to a file, completely or not at all; it is made if it does not exist or is empty.

    Parameters
    ----------
    path : the file.
    mark : the first bytes of the file, which identify its content.
    remedy : the end of the message if the file is damaged.
    fill : function that writes into the open file.

    Raises
    ------
    InputError
        If the file was damaged or cannot be written.
    """
    _restore(path)
    if not path.exists() or path.stat().st_size == 0:
        with replacing(path, marked(mark)) as scratch:
            _write(scratch, mark, {}, "w", fill)
        return
    try:
        with path.open("rb") as raw:
            index = _index(raw, path, mark, remedy)
            _check(raw, path, index, (), remedy)
        with _undone_on_failure(path, index):
            _write(path, mark, dict(index.blocks), "r+", fill)
    except OSError as error:
        raise unwritable(path, error) from error


def read(
    path: Path,
    mark: bytes,
    remedy: str,
    get: "Callable[[h5py.File], T]",
    *,
    arrays: Callable[[str], bool] = lambda _name: True,
) -> T:
    """The return value of ``get``, called with the open file after a check of its digests.

    If another process adds to the file meanwhile, it is read again.

    Parameters
    ----------
    path : the file.
    mark : the first bytes that the file must have.
    remedy : the end of the message if the file is damaged.
    get : function of the open file.
    arrays : whether the dataset of this name is checked; by default all are.

    Raises
    ------
    InputError
        If the file was damaged or changed.
    OSError
        If the file cannot be read.
    """
    import h5py  # slow to import

    while True:
        _restore(path)
        with path.open("rb") as raw:
            header = raw.read(HEADER_BYTES)
            try:
                index = _index(raw, path, mark, remedy)
                _check(raw, path, index, [name for name in index.blocks if arrays(name)], remedy)
                with h5py.File(path, "r", locking=False) as file:
                    result = get(file)
            except Exception:
                if _is_changing(path, header):
                    continue
                raise
            if not _is_changing(path, header):
                return result


def undo_file(path: Path) -> Path:
    """The file that holds what a writer overwrites, while it writes."""
    return path.with_name(f".{path.name}.undo")


def _write(path: Path, mark: bytes, blocks: dict[str, Block], mode: str, fill: Callable[[Writer], None]) -> None:
    """Write into the HDF5 data, then the index, then the header."""
    with _hdf5(path, mode) as file:
        fill(Writer(file, blocks))
    with path.open("r+b") as raw:
        end = raw.seek(0, os.SEEK_END)
        rest = hashlib.sha256()
        for low, high in _gaps(blocks.values(), end):
            rest.update(_piece(raw, low, high))
        entries = {name: [block.offset, block.length, block.checksum] for name, block in blocks.items()}
        index = json.dumps({"blocks": entries, "end": end, "rest": rest.hexdigest()}).encode()
        raw.seek(end)
        raw.write(index)
        raw.seek(0)
        raw.write((mark + f"{hashlib.sha256(index).hexdigest()} {end}\n".encode()).ljust(HEADER_BYTES, b"\0"))
        raw.flush()
        os.fsync(raw.fileno())


class _Disk(io.FileIO):
    """A file that keeps the first error of writing and leaves out all that is written after it.

    HDF5 raises an error of writing again wherever it closes an object, and can crash at the end of the process.
    """

    error: OSError | None = None

    def write(self, data: Any) -> int:
        """Write all bytes, unless the disk has refused some before."""
        left = memoryview(data).cast("B")
        size = left.nbytes
        try:
            while left and self.error is None:
                left = left[super().write(left) :]
        except OSError as error:
            self.error = error
        return size

    def truncate(self, size: int | None = None) -> int:
        """Set the size of the file, unless the disk has refused bytes before."""
        try:
            return super().truncate(size) if self.error is None else 0
        except OSError as error:
            self.error = error
            return 0


@contextmanager
def _hdf5(path: Path, mode: str) -> "Iterator[h5py.File]":
    """An open HDF5 file, new ("w") or as it is ("r+"); OSError at the end if the disk refused to write."""
    import h5py  # slow to import

    options = {"userblock_size": HEADER_BYTES} if mode == "w" else {}
    with _Disk(path, f"{mode}+" if mode == "w" else mode) as disk:
        try:
            with h5py.File(disk, mode, locking=False, **options) as file:
                yield file
        finally:
            if disk.error is not None:
                raise disk.error


def _index(raw: BinaryIO, path: Path, mark: bytes, remedy: str) -> Index:
    """The index of a file, after a check of its digest."""
    raw.seek(0)
    header = raw.read(HEADER_BYTES)
    try:
        digest, place = header.removeprefix(mark).rstrip(b"\0").decode("ascii").split()
        raw.seek(int(place))
        text = raw.read()
        if header.startswith(mark) and hashlib.sha256(text).hexdigest() == digest:
            entries = from_json(text, IndexEntries)
            blocks = {name: Block(*block) for name, block in entries.blocks.items()}
            ordered = sorted(blocks.values(), key=lambda block: block.offset)
            ends = [HEADER_BYTES, *(block.offset + block.length for block in ordered)]
            starts = [*(block.offset for block in ordered), int(place)]
            if entries.end == int(place) and all(end <= start for end, start in zip(ends, starts, strict=True)):
                return Index(blocks, entries.end, entries.rest)
    except ValueError:
        pass
    raise _damaged(path, remedy)


def _check(raw: BinaryIO, path: Path, index: Index, names: Iterable[str], remedy: str) -> None:
    """Raise InputError if the blocks of these names, or the bytes that belong to no block, were damaged."""
    rest = hashlib.sha256()
    for low, high in _gaps(index.blocks.values(), index.end):
        rest.update(_piece(raw, low, high))
    if rest.hexdigest() != index.rest:
        raise _damaged(path, remedy)
    for block in map(index.blocks.__getitem__, names):
        checksum = 0
        for low in range(block.offset, block.offset + block.length, CHUNK_BYTES):
            checksum = zlib.crc32(_piece(raw, low, min(low + CHUNK_BYTES, block.offset + block.length)), checksum)
        if checksum != block.checksum:
            raise _damaged(path, remedy)


def _damaged(path: Path, remedy: str) -> InputError:
    return InputError(f"{path}: was damaged or changed since it was written; {remedy}")


def _piece(raw: BinaryIO, low: int, high: int) -> bytes:
    raw.seek(low)
    return raw.read(high - low)


def _gaps(blocks: Iterable[Block], end: int) -> Iterator[tuple[int, int]]:
    """The ranges of bytes between header and end that belong to no block."""
    low = HEADER_BYTES
    for block in sorted(blocks, key=lambda block: block.offset):
        yield low, block.offset
        low = block.offset + block.length
    yield low, end


def _is_changing(path: Path, header: bytes) -> bool:
    """Whether a process adds to the file now, or has added to it since its header was read."""
    with path.open("rb") as raw:
        return raw.read(HEADER_BYTES) != header or undo_file(path).exists()


@contextmanager
def _undone_on_failure(path: Path, index: Index) -> Iterator[None]:
    """Restore the file if the block fails; if this process is killed, the next one restores it.

    The undo file is locked as long as this process writes.
    """
    with scratch_directory(beside=path) as place, path.open("rb") as raw, (place / "undo").open("w+b") as guard:
        fcntl.lockf(guard, fcntl.LOCK_EX)
        size = raw.seek(0, os.SEEK_END)
        places = [(0, HEADER_BYTES), *_gaps(index.blocks.values(), index.end), (index.end, size)]
        guard.write(json.dumps({"inode": path.stat().st_ino, "size": size, "places": places}).encode() + b"\n")
        guard.writelines(_piece(raw, low, high) for low, high in places)
        guard.flush()
        os.fsync(guard.fileno())
        undo = Path(guard.name).replace(undo_file(path))
        try:
            yield
        except BaseException:
            _undo(guard, path)
            undo.unlink()
            raise
        undo.unlink()


def _restore(path: Path) -> None:
    """Wait until no other process writes into the file, and restore it if the last one was killed meanwhile."""
    undo = undo_file(path)
    while undo.exists():
        holds_data(undo, "remove it")  # refuses a pipe; the file may be gone by now
        try:
            with undo.open("r+b") as guard:
                fcntl.lockf(guard, fcntl.LOCK_EX)
                if is_at(guard.fileno(), undo):
                    _undo(guard, path)
                    undo.unlink()
        except FileNotFoundError:
            continue
        except OSError as error:
            raise InputError(
                f"{undo}: cannot be restored ({error.strerror}); make it and its folder writable"
            ) from error


def _undo(guard: BinaryIO, path: Path) -> None:
    """Write what the undo file holds back into its file, unless that is another one by now."""
    length = guard.seek(0, os.SEEK_END)
    guard.seek(0)
    try:
        entries = from_json(guard.readline(), UndoEntries)
        pieces = [high - low for low, high in entries.places]
        if min(pieces, default=0) < 0 or guard.tell() + sum(pieces) != length:
            raise ValueError("it is not complete")
    except ValueError as error:
        raise InputError(
            f"{undo_file(path)}: is damaged ({error}); remove it, and {path} if that is damaged"
        ) from error
    if not path.exists() or path.stat().st_ino != entries.inode:
        return
    with path.open("r+b") as raw:
        raw.truncate(entries.size)  # first, since the disk may be full
        for low, high in entries.places:
            raw.seek(low)
            raw.write(guard.read(high - low))
        raw.flush()
        os.fsync(raw.fileno())
