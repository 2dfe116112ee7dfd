"""Program that reads one instrument file; it takes a request as JSON and writes one line of JSON and the heights.

Only :mod:`roughfilm.contact.surfaces.instruments` runs it, as a child process.
"""

import json
import math
import os
import sys
import warnings
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.tiff import SIGNATURES, read_tiff
from roughfilm.contact.surfaces.x3p import repaired

FORMATS_WITHOUT_SIGNATURE = {"hgt", "nms"}
"""Formats that any file of the right length matches; they are accepted only with this suffix of the name."""

CONTAINERS = {"h5", "mat", "nc", "npz", "tiff"}
"""Formats of any arrays, of which one must be named where a file holds several."""

FURTHER_SUFFIXES = {"hdf5": "h5", "he5": "h5", "cdf": "nc", "jpk-qi-image": "jpk", "jpk-force-map": "jpk"}
"""Suffixes of formats beside those that the readers name."""

HEIGHT_BYTES, OTHER_BYTES = 8, 1_000_000
"""Largest number of bytes of an archive for each height, and for all else."""

MAX_NAMED = 12
"""Largest number of channels that a message names."""

MAX_QUOTED = 120
"""Number of letters of a reader's own message that are quoted."""

SIGNATURE_BYTES = 512
"""Number of the first bytes of a file by which its format is recognised."""

EQUIDISTANT = 1e-3
"""Largest relative difference of two steps of a profile whose points count as equidistant."""

UNKNOWN_FORMAT = (
    "is in no format that is known here, or damaged; export it again, as X3P, SUR, SDF, TIFF of heights, CSV or text"
)
NO_MAP = "holds no map and no profile of heights; export one from the instrument"


def _candidates(path: str, start: bytes) -> tuple[list[Any], list[Any]]:
    """The readers to try in turn: those that claim the suffix, then those whose signature is that of the file.

    Readers whose signature cannot tell follow, except for formats without one.
    """
    from SurfaceTopography.IO import MagicMatch, readers

    suffix = path.lower().rpartition(".")[2]
    own, sure, maybe = [], [], []
    for reader in readers:
        match = reader.can_read(start)
        if match == MagicMatch.NO:
            continue
        if suffix in (reader.file_extensions() or ()) or FURTHER_SUFFIXES.get(suffix) == reader.format():
            own.append(reader)
        elif match == MagicMatch.YES:
            sure.append(reader)
        elif reader.format() not in FORMATS_WITHOUT_SIGNATURE:
            maybe.append(reader)
    return own, sure + maybe


def _opened(path: str, most: int) -> Any:
    """The first reader that finds a map or a profile in the file; InputError with the reason of the likeliest one."""
    archive = repaired(Path(path), HEIGHT_BYTES * most + OTHER_BYTES)
    with Path(path).open("rb") as file:
        start = file.read(SIGNATURE_BYTES)
    own, others = _candidates(path, start)
    reason = None
    for number, reader in enumerate([*own, *others]):
        try:
            found = reader(path if archive is None else archive)
            if any(one.dim in (1, 2) for one in found.channels):
                return found
            fault = NO_MAP
        except (ImportError, MemoryError):
            raise
        except Exception as error:  # the readers raise many kinds of error for damaged files
            fault = f"cannot be read as {reader.format()} ({_words(error)}); it may be damaged"
        if archive is not None:
            archive.seek(0)
        if number < len(own) and reason is None:
            reason = fault
    raise InputError(reason or UNKNOWN_FORMAT)


def _words(error: Exception) -> str:
    """The kind of an error and its message in one short line, which may quote bytes of the file, without controls."""
    message = "".join(letter if letter.isprintable() else " " for letter in str(error))
    return f"{type(error).__name__}: {' '.join(message.split())[:MAX_QUOTED]}"


def _read(path: str, channel: str | None, most: int) -> tuple[dict[str, Any], Any]:
    from SurfaceTopography.Support.UnitConversion import get_unit_conversion_factor

    try:
        reader = _opened(path, most)
    except InputError as error:
        return _of_image(path, channel, most) or ({"fault": str(error)}, None)
    channels = [one for one in reader.channels if one.dim in (1, 2)]
    listed = [f"{one.name!r} ({' x '.join(str(int(n)) for n in one.nb_grid_pts)})" for one in channels]
    names = ", ".join(listed[:MAX_NAMED]) + (f" and {len(listed) - MAX_NAMED} more" if len(listed) > MAX_NAMED else "")
    if channel is None and reader.format() in CONTAINERS and len(channels) > 1:
        example = f"name one, as in read.channel={channels[0].name}"
        return {"fault": f"holds {len(channels)} arrays: {names}; {example}"}, None
    chosen = reader.default_channel if channel is None else None
    if chosen is not None and chosen.dim not in (1, 2):
        chosen = channels[0]
    for one in channels:
        if channel is not None and one.name == channel:
            chosen = one
    if chosen is None:
        return {"fault": f"has no channel {channel!r}; its channels are {names}"}, None
    if str(chosen.data_kind).rpartition(".")[2].lower() != "height":
        return {"fault": f"channel {chosen.name!r} holds no heights; its channels are {names}"}, None
    points = tuple(int(count) for count in chosen.nb_grid_pts)
    if math.prod(points) > most:
        claimed = " x ".join(map(str, points))
        return {"fault": f"claims {claimed} points; at most {most} fit a file of its length"}, None
    known = chosen.physical_sizes is not None
    topography = reader.topography(
        channel_index=chosen.index, **({} if known else {"physical_sizes": tuple(map(float, points))})
    )
    heights = np.ma.filled(np.ma.asarray(topography.heights(), dtype=np.float64), np.nan)
    if chosen.dim == 1 and not topography.is_uniform:
        places = np.asarray(topography.positions(), dtype=float)
        apart = np.diff(places)
        if not np.ptp(apart) <= EQUIDISTANT * abs(apart.mean()):
            return {"fault": "is a profile whose points are not equidistant; export it with equal steps"}, None
        lengths: Any = [apart.mean() * heights.size]
    else:
        lengths = topography.physical_sizes if known else None
    unit = topography.unit
    factor = get_unit_conversion_factor(unit, "m") if unit is not None else None
    size = [float(length) * factor for length in lengths] if lengths is not None and factor else None
    bare = lengths is not None and unit is None  # x, y and z without a unit have one unit
    steps = [float(length) / count for length, count in zip(lengths, heights.shape, strict=True)] if bare else None
    header = {"shape": heights.shape, "height_unit": unit, "size": size, "steps": steps}
    return {**header, "format": reader.format(), "channel": chosen.name}, heights


def _of_image(path: str, channel: str | None, most: int) -> tuple[dict[str, Any], Any] | None:
    """The header and the heights of a TIFF that no reader of an instrument's takes; None for another format."""
    with Path(path).open("rb") as file:
        if not file.read(SIGNATURE_BYTES).startswith(SIGNATURES):
            return None
    try:
        name, heights = read_tiff(path, channel, most)
    except InputError as error:
        return {"fault": str(error)}, None
    header = {"shape": heights.shape, "height_unit": None, "size": None, "steps": None}
    return {**header, "format": "tiff", "channel": name}, heights


def main(request: dict[str, Any], out: BinaryIO) -> None:
    """Read the file named in ``request`` and write header and heights to ``out``; a fault gives ``{"fault": text}``."""
    try:
        header, heights = _read(request["path"], request["channel"], request["most"])
    except ImportError as error:
        header, heights = {"missing": " ".join(str(error).split())[:120]}, None
    except MemoryError:
        header, heights = {"fault": "needs more memory than a file of its length should; it may be damaged"}, None
    except Exception as error:  # the readers raise many kinds of error for damaged files
        header, heights = {"fault": f"cannot be read ({_words(error)}); it may be damaged"}, None
    out.write(json.dumps(header).encode() + b"\n")
    if heights is not None:
        out.write(np.ascontiguousarray(heights).data)
    out.flush()


def _limit(memory: int, seconds: int) -> None:
    try:
        import resource
    except ImportError:  # absent on Windows, where the parent limits the time only
        return
    resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))


if __name__ == "__main__":
    warnings.simplefilter("ignore")
    request = json.loads(sys.argv[1])
    pipe = os.fdopen(os.dup(1), "wb")
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # output printed by a reader must not reach the pipe
    _limit(request["memory"], request["seconds"])
    main(request, pipe)
