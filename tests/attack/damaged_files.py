"""Damaged and forged files of every kind, what the commands answer to each, and whether the answer is sound.

An answer is sound if the file is refused in one line, or read without fault. A file with a digest whose bytes were
changed gives the answer of the good file or none. Each file is read within limits on memory and time.
"""

import contextlib
import json
import os
import random
import resource
import shutil
import signal
import socket
import tempfile
import traceback
import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from attack.good_files import KINDS, GoodFile
from forging import forge, sign

from roughfilm.contact.foundation.errors import ConvergenceError, InputError, UnavailableError

CPU_LIMIT_S = 20
"""CPU time for one file, s, beyond which reading it counts as endless."""

WAITING_LIMIT_S = 600
"""Time for one file, s, beyond which a reader that takes no CPU time, as one of a pipe does, counts as endless."""

MEMORY = 3 << 30
"""Address space that reading one file may take more, bytes."""

MAX_LINE = 400
"""Largest length of a message."""

ERRORS = InputError, ConvergenceError, UnavailableError

FORGERIES = (
    *("delete", "rename", "number", "type", "text", "shape", "empty", "group", "committed", "json", "json"),
    *("attribute deleted", "attribute of another type", "attribute forged"),
    *("claims much", "claims much in chunks", "chunks", "long text", "filters"),
    *("link", "external link", "external"),
)
"""Changes of the content of an HDF5 file."""

HUGE = (1_000_000, 1_000_000)
"""A shape that no file holds."""


@dataclass(frozen=True)
class Answer:
    """What happened to one file: ``read``, ``refused`` or ``fault``, and the words on it."""

    seed: int
    kind: str
    damage: str
    outcome: str
    words: str = ""


def flip(chance: random.Random, data: bytes) -> bytes:
    """Change some bits."""
    changed = bytearray(data)
    for _ in range(chance.choice((1, 1, 2, 8, 64))):
        if changed:
            changed[chance.randrange(len(changed))] ^= 1 << chance.randrange(8)
    return bytes(changed)


def truncate(chance: random.Random, data: bytes) -> bytes:
    """Leave out the end."""
    return data[: chance.choice((0, 1, 8, len(data) // 2, max(0, len(data) - 1), chance.randrange(len(data) + 1)))]


def blank(chance: random.Random, data: bytes) -> bytes:
    """Overwrite a piece by zeros or ones."""
    low = chance.randrange(len(data) + 1)
    high = min(len(data), low + chance.choice((1, 16, 512, 4096)))
    return data[:low] + chance.choice((b"\0", b"\xff", b"9", b"[")) * (high - low) + data[high:]


def insert(chance: random.Random, data: bytes) -> bytes:
    """Insert a piece."""
    pieces = (
        b"\0" * 100,
        b"\xff\xfe",
        b"nan",
        b"-1e999",
        b"1e308",
        b"9" * 5000,
        b"[" * 3000,
        b"{",
        b'"',
        b"\n",
        b"\x1b[2J",
    )
    place = chance.randrange(len(data) + 1)
    return data[:place] + chance.choice(pieces) + data[place:]


def exchange(chance: random.Random, data: bytes) -> bytes:
    """Exchange two pieces."""
    low, middle, high = sorted(chance.randrange(len(data) + 1) for _ in range(3))
    return data[:low] + data[middle:high] + data[low:middle] + data[high:]


def lines(chance: random.Random, data: bytes) -> bytes:
    """Leave out, repeat or lengthen a line."""
    found = data.splitlines(keepends=True) or [b""]
    place = chance.randrange(len(found))
    found[place : place + 1] = chance.choice(
        ([], [found[place]] * 2, [found[place].rstrip(b"\n") * 1000 + b"\n"], [b"0," * 100_000 + b"0\n"])
    )
    return b"".join(found)


def numbers(chance: random.Random, data: bytes) -> bytes:
    """Replace a number of a text by another one."""
    import re

    found = list(re.finditer(rb"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?", data))
    if not found:
        return data
    one = chance.choice(found)
    new = chance.choice(
        (b"0", b"-1", b"1e308", b"1e-308", b"nan", b"inf", b"100000000", b"10" * 40, b"true", b"[1]", b'"a"')
    )
    return data[: one.start()] + new + data[one.end() :]


def replace_all(chance: random.Random, _data: bytes) -> bytes:
    """Put something else in its place."""
    return chance.choice(
        (
            b"",
            b"\0" * 100_000,
            os.urandom(100),
            b"\x89HDF\r\n\x1a\n" + b"\0" * 500,
            b"\x93NUMPY\x01\x00v\x00{'descr': '<f8', 'fortran_order': False, 'shape': (30000, 30000), }"
            + b" " * 20
            + b"\n",
            b"[" * 100_000,
            b'{"a":' * 100_000,
            b"a." * 100_000 + b"a = 1",
            b"a = " + b"[" * 10_000 + b"]" * 10_000,
            b"a = 0x" + b"f" * 100_000,
            b"x" * 1_000_000,
            b"0," * 500_000,
            b"PK\x03\x04" + b"\0" * 100,
        )
    )


BYTES: Sequence[Callable[[random.Random, bytes], bytes]] = (
    flip,
    flip,
    truncate,
    blank,
    insert,
    exchange,
    lines,
    numbers,
    numbers,
    replace_all,
)


def special(chance: random.Random, path: Path) -> str:
    """Put a pipe, a device, a directory, a socket or a link in the place of a file."""
    path.unlink()
    kind = chance.choice(("pipe", "zero", "full", "directory", "socket", "loop", "nowhere", "closed"))
    match kind:
        case "pipe":
            os.mkfifo(path)
        case "zero" | "full":
            path.symlink_to(f"/dev/{kind}")
        case "directory":
            path.mkdir()
        case "socket":
            here = os.getcwd()
            os.chdir(path.parent)
            with socket.socket(socket.AF_UNIX) as one:
                one.bind(path.name)
            os.chdir(here)
        case "loop":
            path.symlink_to(path.name)
        case "nowhere":
            path.symlink_to("nowhere")
    return f"special: {kind}"


def _names(file: h5py.File) -> list[str]:
    names: list[str] = []
    file.visit(names.append)
    return sorted(names)


def _put(file: h5py.File, name: str, **options: Any) -> Any:
    """Make a dataset again with the attributes of the one before."""
    attributes = dict(file[name].attrs)
    del file[name]
    dataset = file.create_dataset(name, **options)
    dataset.attrs.update(attributes)
    return dataset


def _changed_number(chance: random.Random, values: Any) -> Any:
    values = np.array(values)
    if values.dtype.kind == "f" and values.size:
        values.flat[chance.randrange(values.size)] = chance.choice((np.nan, np.inf, -1.0, 0.0, 1e308, 1e-308))
    elif values.dtype.kind in "iu" and values.size:
        values.flat[chance.randrange(values.size)] = chance.choice((-1, 0, 2**31 - 1))
    return values


def forged(chance: random.Random, file: h5py.File, folder: Path) -> str:
    """Change the content of an HDF5 file in one way, and return its name."""
    names = _names(file)
    name = chance.choice(names)
    sets = [one for one in names if isinstance(file[one], h5py.Dataset)]
    place = chance.choice(sets)
    owners = [one for one in ["/", *names] if file[one].attrs]
    owner = file[chance.choice(owners)].attrs
    attribute = chance.choice(sorted(owner))
    what = chance.choice(FORGERIES)
    match what:
        case "delete":
            del file[name]
        case "rename":
            file.move(name, f"{name}-{chance.choice(('x', 'é', '@', ' '))}")
        case "attribute deleted":
            del owner[attribute]
        case "attribute of another type":
            owner[attribute] = chance.choice(
                (7, -1.5, "seven", b"\xff", [1, 2, 3], ["a", "b"], True, h5py.Empty("f"), np.zeros(7000))
            )
        case "attribute forged":
            owner[attribute] = (
                _changed_number(chance, owner[attribute]) if not isinstance(owner[attribute], str) else "\x1b[2J" * 50
            )
        case "json":
            texts = [one for one in sorted(file.attrs) if str(file.attrs[one]).startswith(("{", "["))]
            if texts:
                one = chance.choice(texts)
                file.attrs[one] = json_changed(chance, file.attrs[one])
        case "number":
            if file[place].dtype.kind in "fiu":
                file[place][...] = _changed_number(chance, file[place][()])
        case "type":
            _put(
                file,
                place,
                data=np.zeros(
                    file[place].shape, dtype=chance.choice(("c16", "i1", "f2", "S3", "u8", "?", [("a", "f8")]))
                ),
            )
        case "text":
            _put(file, place, data=chance.choice(("text", b"\xff\xfe", ["a", "b"])))
        case "shape":
            _put(file, place, data=np.zeros(chance.choice(((), (0,), (1,), (3, 0), (2, 2, 2), (7, 5)))))
        case "empty":
            _put(file, place, data=h5py.Empty("f8"))
        case "claims much":
            _put(file, place, shape=HUGE if file[place].ndim == 2 else (10**12,), dtype="f8")
        case "claims much in chunks":
            _put(
                file,
                place,
                shape=chance.choice((HUGE, (45_000, 45_000))),
                dtype="f8",
                chunks=(1000, 1000),
                compression="gzip",
                fillvalue=1.0,
            )
        case "chunks":
            old = file[place].shape or (1,)
            _put(
                file,
                place,
                shape=old,
                maxshape=(None,) * len(old),
                dtype="f8",
                chunks=(int(3e8 ** (1 / len(old))),) * len(old),
            )
        case "link":
            del file[name]
            file[name] = h5py.SoftLink(chance.choice(("/", "/nowhere", f"/{name}")))
        case "external link":
            del file[name]
            file[name] = h5py.ExternalLink(str(folder / "pipe"), "/x")
        case "external":
            file_set = file[place]
            if file_set.size and file_set.dtype.kind == "f":
                _put(file, place, shape=file_set.shape, dtype="f8", external=[("/dev/zero", 0, h5py.h5f.UNLIMITED)])
        case "group":
            del file[place]
            file.create_group(place)
        case "long text":
            texts = ["x" * 1_000_000]
            _put(file, place, data=texts * 2)
        case "filters":
            if file[place].dtype.kind == "f" and file[place].ndim:
                _put(file, place, data=file[place][()], scaleoffset=2)
        case "committed":
            del file[name]
            file[name] = np.dtype("f8")
    return f"forged: {what} {name if what in ('delete', 'rename', 'link') else place}"


def json_changed(chance: random.Random, text: str) -> str:
    """JSON text with one change."""
    entries = json.loads(text)
    if chance.random() < 0.15:
        return chance.choice(
            ("", "[]", "{}", "null", "NaN", "1e999", "[" * 5000, text[:-1], '{"a": "' + "x" * 100_000 + '"}')
        )
    places: list[tuple[Any, Any]] = []

    def collect(part: Any) -> None:
        for key in part if isinstance(part, dict) else range(len(part)):
            places.append((part, key))
            if isinstance(part[key], dict | list):
                collect(part[key])

    collect(entries)
    if places:
        part, key = chance.choice(places)
        if chance.random() < 0.4:
            del part[key]
        else:
            part[key] = chance.choice(
                (None, True, -1, 10**30, 1e308, float("nan"), float("inf"), "", "x", [], {}, [[]], {"a": 1})
            )
    return json.dumps(entries)


def damaged(path: Path, seed: int, *, signed: bool) -> tuple[str, bool]:
    """Damage a file by a seed; the name of the damage, and whether its digest is that of its content."""
    chance = random.Random(seed)
    if chance.random() < 0.04:
        return special(chance, path), True
    data = path.read_bytes()
    hdf5 = signed or data.startswith(b"\x89HDF") or b"HDF5 behind" in data[:100]
    if hdf5 and chance.random() < 0.7:
        if not signed and b"HDF5 behind" not in data[:100]:
            with h5py.File(path, "r+") as file:
                return forged(chance, file, path.parent), True
        if b"sha256 " in data[:100] and b"contact," in data[:100]:
            return _forged_growing(chance, path), True
        words = ""

        def change(file: h5py.File) -> None:
            nonlocal words
            words = forged(chance, file, path.parent)

        forge(path, change)
        return words, True
    if path.suffix == ".json" and chance.random() < 0.7:
        path.write_text(json_changed(chance, path.read_text(encoding="utf-8")), encoding="utf-8")
        return "json", True
    way = chance.choice(BYTES)
    changed = way(chance, data)
    if hdf5 and signed and chance.random() < 0.3 and b"contact," not in data[:100]:
        sign(path, data[:512] + way(chance, data[512:]))
        return f"signed {way.__name__}", True
    path.write_bytes(changed)
    return way.__name__, changed == data


def _forged_growing(chance: random.Random, path: Path) -> str:
    """Forge a file of contacts, whose index is written again."""
    from roughfilm.contact.foundation import growing_hdf5 as growing
    from roughfilm.contact.mechanics.store import MARK

    words = ""

    def change(writer: growing.Writer) -> None:
        nonlocal words
        words = forged(chance, writer.file, path.parent)
        writer._blocks.clear()

    growing.grow(path, MARK, "", change)
    return words


class Endless(BaseException):
    """Reading a file took longer than ``CPU_LIMIT_S`` or ``WAITING_LIMIT_S``."""


def judged(seed: int, kind: str, good: Path, folder: Path, expected: Any) -> Answer:
    """Copy a good file with what belongs to it into a folder, damage it, read it and judge the answer."""
    shutil.copytree(good, folder)
    path = _place(folder)
    shown: list[str] = []
    try:
        damage, right = damaged(path, seed, signed=KINDS[kind].signed)
    except Exception:  # the change itself is impossible in this file
        return Answer(seed, kind, "none", "read", traceback.format_exc(limit=-1))
    try:
        with _limited(), warnings.catch_warnings():
            warnings.simplefilter("error")
            found = KINDS[kind].read(path)
        if KINDS[kind].signed and not right and found != expected:
            shown.append(f"another answer: {found!r:.300}")
    except ERRORS as error:
        words = str(error)
        if not words or max(map(len, words.replace(str(folder), "").splitlines())) > MAX_LINE:
            return Answer(seed, kind, damage, "fault", f"message: {words:.2000}")
        return Answer(seed, kind, damage, "refused", words)
    except (Exception, Endless):
        return Answer(seed, kind, damage, "fault", traceback.format_exc())
    return Answer(seed, kind, damage, "fault" if shown else "read", "".join(shown))


def _place(folder: Path) -> Path:
    """The file of a folder that is damaged, whose name is in the file ``.damaged``."""
    return folder / (folder / ".damaged").read_text(encoding="utf-8")


@contextlib.contextmanager
def _limited() -> Iterator[None]:
    def stop(_number: int, _frame: object) -> None:
        raise Endless

    limits = (
        (signal.ITIMER_PROF, signal.SIGPROF, CPU_LIMIT_S),
        (signal.ITIMER_REAL, signal.SIGALRM, WAITING_LIMIT_S),
    )
    before = [signal.signal(number, stop) for _, number, _ in limits]
    for timer, _, limit in limits:
        signal.setitimer(timer, limit)
    try:
        yield
    finally:
        for (timer, number, _), handler in zip(limits, before, strict=True):
            signal.setitimer(timer, 0)
            signal.signal(number, handler)


def made(kind: GoodFile, folder: Path) -> Path:
    """Write a good file into a folder, which is returned."""
    folder.mkdir()
    path = kind.make(folder)
    (folder / ".damaged").write_text(str(path.relative_to(folder)), encoding="utf-8")
    return folder


def answers(seeds: Sequence[int], kinds: Sequence[str] = tuple(KINDS), step: int = 40) -> Iterator[Answer]:
    """The answers of some seeds, the kinds in turn; child processes with a limit of memory read the files."""
    with tempfile.TemporaryDirectory(prefix="damaged-") as place:
        good = {kind: made(KINDS[kind], Path(place) / f"good-{number}") for number, kind in enumerate(kinds)}
        expected = {kind: KINDS[kind].read(_place(good[kind])) for kind in kinds}
        work = [(seed, kinds[seed % len(kinds)]) for seed in seeds]
        while work:
            done = [*_in_child(work[:step], good, expected, Path(place) / "work")]
            yield from done
            work = work[len(done) :]


def _in_child(
    work: Sequence[tuple[int, str]], good: dict[str, Path], expected: dict[str, Any], folder: Path
) -> Iterator[Answer]:
    """The answers of a child process; where it dies, the answer of the file that it read is the last."""
    ours, theirs = os.pipe()
    child = os.fork()
    if child == 0:
        with os.fdopen(theirs, "w") as pipe:
            used = 4096 * int(Path("/proc/self/statm").read_text().split()[0])
            resource.setrlimit(resource.RLIMIT_AS, (used + MEMORY, used + MEMORY))
            for seed, kind in work:
                answer = judged(seed, kind, good[kind], folder, expected[kind])
                shutil.rmtree(folder, ignore_errors=True)
                pipe.write(json.dumps(asdict(answer)) + "\n")
                pipe.flush()
        os._exit(0)
    os.close(theirs)
    count = 0
    with os.fdopen(ours) as pipe:
        for line in pipe:
            count += 1
            yield Answer(**json.loads(line))
    _, status = os.waitpid(child, 0)
    shutil.rmtree(folder, ignore_errors=True)
    if count < len(work):
        seed, kind = work[count]
        yield Answer(seed, kind, "unknown", "fault", f"the process ended with status {status}")
