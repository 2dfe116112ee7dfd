"""Instrument files, read by SurfaceTopography in a child process.

A damaged file can make a reader exhaust memory, run for ever, crash or print. Therefore the reader runs in a child
process with limits on memory and time, which passes the heights through a pipe.
"""

import json
import os
import subprocess
import sys
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.child_processes import terminate_with_parent
from roughfilm.contact.foundation.errors import InputError, UnavailableError
from roughfilm.contact.surfaces.surface import MAX_POINTS

POINTS_PER_BYTE = 50
"""Upper bound on the points for each byte of a file; a header that claims more is damaged."""

MEMORY_LIMIT = 4 << 30, 40
"""Memory limit of the reader, bytes: a constant, and bytes for each byte of the file."""

CPU_TIME_LIMIT = 60, 4e-6
"""CPU time limit of the reader, s: a constant, and seconds for each byte of the file."""


@dataclass(frozen=True, kw_only=True)
class Measurement:
    """The content of a measurement file.

    Attributes
    ----------
    heights : shape (nx, ny), or (n,) for a profile, in the unit of the file; NaN where invalid.
    height_unit : unit of the heights; None if the file does not give it.
    size : length along each axis, m; None if the file does not give it.
    format : name of the file format.
    channel : name of the channel; empty for formats without channels.
    steps : distance of the points along each axis in the unit of the heights; None if the file does not give it.
    """

    heights: Array
    height_unit: str | None
    size: tuple[float, ...] | None
    format: str
    channel: str
    steps: tuple[float, ...] | None = None


def read_instrument(path: Path, channel: str | None = None) -> Measurement:
    """Read one channel of heights, by default the default channel of the file.

    Raises
    ------
    InputError
        If the format is unknown, the file is damaged or claims more points than its length or the limit of 100
        million allows, or it has no such channel of heights.
    UnavailableError
        If SurfaceTopography is not installed, or does not load.
    """
    if find_spec("SurfaceTopography") is None:
        raise UnavailableError(
            f"{path}: instrument files need SurfaceTopography; install it with: pip install 'roughfilm[instruments]'"
        )
    length = path.stat().st_size
    memory, seconds = (int(least + each * length) for least, each in (MEMORY_LIMIT, CPU_TIME_LIMIT))
    request = {
        "path": str(path.resolve()),
        "channel": channel,
        "most": min(MAX_POINTS, POINTS_PER_BYTE * length),
        "memory": memory,
        "seconds": seconds,
    }
    search_path = os.pathsep.join([str(Path(__file__).resolve().parents[2]), *filter(None, sys.path)])
    try:
        child = subprocess.run(
            [
                *terminate_with_parent(),
                sys.executable,
                "-m",
                "roughfilm.contact.surfaces.instrument_reader",
                json.dumps(request),
            ],
            capture_output=True,
            stdin=subprocess.DEVNULL,
            env={**os.environ, "PYTHONPATH": search_path, "OPENBLAS_NUM_THREADS": "1"},
            timeout=4 * seconds,
            check=False,
        )
    except subprocess.TimeoutExpired:
        raise InputError(f"{path}: reading it took more than {4 * seconds} s; the file may be damaged") from None
    header, _, data = child.stdout.partition(b"\n")
    if child.returncode != 0 or not header:
        raise InputError(f"{path}: its reader broke down (exit {child.returncode}); the file may be damaged")
    reply = json.loads(header)
    if "missing" in reply:
        raise UnavailableError(f"{path}: SurfaceTopography does not load ({reply['missing']}); install it again")
    if "fault" in reply:
        raise InputError(f"{path}: {reply['fault']}")
    size = reply["size"]
    return Measurement(
        heights=np.frombuffer(data).reshape(reply["shape"]),
        height_unit=reply["height_unit"],
        size=None if size is None else tuple(size),
        format=reply["format"],
        channel=reply["channel"],
        steps=None if reply["steps"] is None else tuple(reply["steps"]),
    )
