"""Program that reads one instrument file; it takes a request as JSON and writes one line of JSON and the heights.

Only :mod:`roughfilm.contact.surfaces.instruments` runs it, as a child process.
"""

import json
import os
import sys
import warnings
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.x3p import repaired

FORMATS_WITHOUT_SIGNATURE = {"hgt", "nms"}
"""Formats that any file of the right length matches; they are accepted only with this suffix of the name."""

HEIGHT_BYTES, OTHER_BYTES = 8, 1_000_000
"""Largest number of bytes of an archive for each height, and for all else."""

UNKNOWN_FORMAT = "is in no format that is known here, or damaged; export it again from the instrument"


def _read(path: str, channel: str | None, most: int) -> tuple[dict[str, Any], Any]:
    from SurfaceTopography import open_topography
    from SurfaceTopography.Exceptions import CannotDetectFileFormat
    from SurfaceTopography.Support.UnitConversion import get_unit_conversion_factor

    try:
        archive = repaired(Path(path), HEIGHT_BYTES * most + OTHER_BYTES)
        reader = open_topography(path) if archive is None else open_topography(archive, format="x3p")
    except InputError as error:
        return {"fault": str(error)}, None
    except CannotDetectFileFormat:
        return {"fault": UNKNOWN_FORMAT}, None
    if reader.format() in FORMATS_WITHOUT_SIGNATURE and not path.lower().endswith(reader.format()):
        return {"fault": UNKNOWN_FORMAT}, None
    channels = [one for one in reader.channels if one.dim == 2]
    names = ", ".join(repr(one.name) for one in channels)
    if not channels:
        return {"fault": "holds no map of heights; export one from the instrument"}, None
    chosen = reader.default_channel if channel is None else None
    for one in channels:
        if channel is not None and one.name == channel:
            chosen = one
    if chosen is None or chosen.dim != 2:
        return {"fault": f"has no channel {channel!r}; its channels are {names}"}, None
    if str(chosen.data_kind).rpartition(".")[2].lower() != "height":
        return {"fault": f"channel {chosen.name!r} holds no heights; its channels are {names}"}, None
    nx, ny = (int(count) for count in chosen.nb_grid_pts)
    if nx * ny > most:
        return {"fault": f"claims {nx} x {ny} points; at most {most} fit a file of its length"}, None
    known = chosen.physical_sizes is not None
    topography = reader.topography(
        channel_index=chosen.index, **({} if known else {"physical_sizes": (float(nx), float(ny))})
    )
    heights = np.ma.filled(np.ma.asarray(topography.heights(), dtype=np.float64), np.nan)
    unit = topography.unit
    factor = get_unit_conversion_factor(unit, "m") if unit is not None else None
    size = [float(length) * factor for length in topography.physical_sizes] if known and factor else None
    header = {"shape": heights.shape, "height_unit": unit, "size": size}
    return {**header, "format": reader.format(), "channel": chosen.name}, heights


def main(request: dict[str, Any], out: BinaryIO) -> None:
    """Read the file named in ``request`` and write header and heights to ``out``; a fault gives ``{"fault": text}``."""
    try:
        header, heights = _read(request["path"], request["channel"], request["most"])
    except ImportError as error:
        header, heights = {"missing": " ".join(str(error).split())[:120]}, None
    except MemoryError:
        header, heights = {"fault": "needs more memory than a file of its length should; it may be damaged"}, None
    except Exception as error:  # the readers raise many kinds of error for damaged files
        reason = " ".join(str(error).split())[:120]
        header, heights = {"fault": f"cannot be read ({type(error).__name__}: {reason}); it may be damaged"}, None
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
