"""Planned Fourier transforms of real grids; what planning finds out is kept for the next run on this machine."""

import json
import os
from functools import cache
from pathlib import Path
from typing import Any

import pyfftw

from contact.errors import InputError
from contact.files import replacing


def plans(real: Any, spectrum: Any, threads: int) -> tuple[Any, Any]:
    """Plans for the transform of ``real`` into ``spectrum`` and for the way back, not normalised.

    The way back loses its input. Both arrays are overwritten by the planning. A plan runs on other arrays of the same
    shape, kind and alignment by ``update_arrays``.
    """
    _recall()
    before = pyfftw.export_wisdom()
    options = {"axes": (0, 1), "flags": ("FFTW_MEASURE",), "threads": threads}
    forward = pyfftw.FFTW(real, spectrum, **options)
    backward = pyfftw.FFTW(spectrum, real, direction="FFTW_BACKWARD", **options)
    if pyfftw.export_wisdom() != before:
        _keep()
    return forward, backward


def _file() -> Path:
    home = os.environ.get("XDG_CACHE_HOME") or "~/.cache"
    return Path(home).expanduser() / "roughfilm" / f"transforms-{pyfftw.__version__}.json"


@cache
def _recall() -> None:
    """Take up what earlier runs kept; a file that cannot be understood is as good as none."""
    try:
        kept = json.loads(_file().read_text(encoding="ascii"))
        pyfftw.import_wisdom(tuple(text.encode("ascii") for text in kept))
    except (OSError, ValueError, TypeError, AttributeError, RuntimeError):
        return


def _keep() -> None:
    """Keep what is known by now; where there is no place for it, the next run plans again."""
    try:
        with replacing(_file()) as scratch:
            scratch.write_text(json.dumps([text.decode("ascii") for text in pyfftw.export_wisdom()]), encoding="ascii")
    except InputError:
        return
