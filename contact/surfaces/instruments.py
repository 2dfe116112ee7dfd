"""Instrument files, read by SurfaceTopography in a process of its own.

A damaged file can make a reader take all memory, never end, crash or write on standard output. So the reader runs as a
child with limits on memory and time, and hands heights over through a pipe.
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
"""No format packs more points into a byte of a file that holds a measurement."""

MEMORY = 4 << 30, 40
"""Bytes that reading may take: this many, and so many for each byte of the file."""

SECONDS = 60, 4e-6
"""CPU time that reading may take: this much, and so much for each byte of the file."""


@dataclass(frozen=True, kw_only=True)
class Measurement:
    """What a file says: heights[x, y] in its unit, NaN where invalid; size along x and y in m; None where silent."""

    heights: Array
    height_unit: str | None
    size: tuple[float, float] | None
    format: str
    channel: str


def read_instrument(path: Path, channel: str | None = None) -> Measurement:
    """Read one channel of heights, by default the file's own first choice.

    Raises
    ------
    InputError
        If no reader knows the file, it is damaged, claims more points than fit into its length or than 100 million,
        or has no such channel of heights.
    UnavailableError
        If SurfaceTopography is not installed, or does not load.
    """
    if find_spec("SurfaceTopography") is None:
        raise UnavailableError(
            f"{path}: instrument files need SurfaceTopography; install it with: pip install 'roughfilm[instruments]'"
        )
    length = path.stat().st_size
    memory, seconds = (int(least + each * length) for least, each in (MEMORY, SECONDS))
    asked = {"path": str(path.resolve()), "channel": channel, "most": min(MAX_POINTS, POINTS_PER_BYTE * length)}
    request = json.dumps({**asked, "memory": memory, "seconds": seconds})
    places = os.pathsep.join([str(Path(__file__).resolve().parents[2]), *filter(None, sys.path)])
    try:
        child = subprocess.run(
            [*terminate_with_parent(), sys.executable, "-m", "roughfilm.contact.surfaces.instrument_reader", request],
            capture_output=True,
            stdin=subprocess.DEVNULL,
            env={**os.environ, "PYTHONPATH": places, "OPENBLAS_NUM_THREADS": "1"},
            timeout=4 * seconds,
            check=False,
        )
    except subprocess.TimeoutExpired:
        raise InputError(f"{path}: reading it took more than {4 * seconds} s; the file may be damaged") from None
    head, _, rest = child.stdout.partition(b"\n")
    if child.returncode != 0 or not head:
        raise InputError(f"{path}: its reader broke down (exit {child.returncode}); the file may be damaged")
    told = json.loads(head)
    if "missing" in told:
        raise UnavailableError(f"{path}: SurfaceTopography does not load ({told['missing']}); install it again")
    if "fault" in told:
        raise InputError(f"{path}: {told['fault']}")
    size = told["size"]
    return Measurement(
        heights=np.frombuffer(rest).reshape(told["shape"]),
        height_unit=told["height_unit"],
        size=None if size is None else (size[0], size[1]),
        format=told["format"],
        channel=told["channel"],
    )
