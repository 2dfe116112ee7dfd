"""Surfaces to press or to film: files that `roughfilm surface` takes, synthetic ones, and arrays of heights."""

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.units import to_si
from roughfilm.contact.surfaces.files import read_surface
from roughfilm.contact.surfaces.periodicity import MISMATCH_THRESHOLD, periodicity_mismatch
from roughfilm.contact.surfaces.store import is_surface
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.description import make, read_description


@dataclass(frozen=True, kw_only=True)
class Rough:
    """Heights, shape (nx, ny), m, with spacing, m; ny = 1 for a profile."""

    heights: Array
    spacing: tuple[float, float]
    source: Mapping[str, Any]
    warnings: tuple[str, ...]


def spacing_of(text: str | None) -> tuple[float, float] | None:
    """One length or two, such as "1um" or "1um,2um", in m; InputError for anything else."""
    if text is None:
        return None
    parts = text.split(",")
    try:
        lengths = [to_si(part.strip(), "m") for part in parts]
    except ValueError as error:
        raise InputError(f"--spacing {text}: {error}") from None
    if len(lengths) > 2 or not min(lengths) > 0:
        raise InputError(f"--spacing {text}: give one length above 0 or two, such as 1um or 1um,2um")
    return lengths[0], lengths[-1]


def read_rough(file: Path, spacing: tuple[float, float] | None, *, periodic: bool, otherwise: str = "") -> Rough:
    """Read a surface as it is.

    Parameters
    ----------
    spacing : (dx, dy), m, of an array of heights.
    periodic : whether it will be taken as periodic, and a warning is due if it is not.
    otherwise : what else than preparing it can be done about that, for the warning.

    Raises
    ------
    InputError
        One line, if the file is no surface, tells no spacing, or has invalid points.
    """
    suffix = file.suffix.lower()
    try:
        there = file.exists()
    except OSError as error:
        raise InputError(f"{file}: cannot be read ({error.strerror}); name a surface") from None
    if not there:
        raise InputError(f"{file}: there is no such file; name a surface")
    whole = suffix == ".toml" or (file.is_file() and is_surface(file))
    if whole and spacing is not None:
        raise InputError(f"{file}: says its spacing itself; leave out --spacing")
    if suffix == ".npy" and spacing is None:
        raise InputError(f"{file}: tells no spacing of its points; give --spacing, such as 1um")
    if suffix == ".npy":
        profile = _profile(file)
        if profile is not None and spacing is not None:
            return _rough(file, *_along_x(profile, spacing), periodic, otherwise)
    if suffix == ".toml":
        surface = make(read_description(file))
    else:
        try:
            surface = read_surface(file, spacing=spacing)
        except InputError as error:
            told = " in a recipe of roughfilm surface, and take its --out"
            raise InputError(str(error).replace(" in the recipe", told)) from None
    if surface.invalid.any():
        count = int(surface.invalid.sum())
        raise InputError(f"{file}: has {count} invalid points; fill them: roughfilm surface {file} --out S.h5")
    return Rough(
        heights=surface.heights,
        spacing=surface.spacing,
        source=surface.source,
        warnings=joint_warnings(file, surface, otherwise, measured=not whole and suffix != ".npy") if periodic else (),
    )


def _profile(file: Path) -> Array | None:
    """Heights along a line, of shape (n,), (n, 1) or (1, n); None if the file holds something else."""
    if not file.is_file():
        return None
    try:
        array = np.load(file, mmap_mode="r", allow_pickle=False)
    except (OSError, ValueError, EOFError, SyntaxError):
        return None
    if array.dtype.kind not in "fiu" or not (array.ndim == 1 or (array.ndim == 2 and 1 in array.shape)):
        return None
    return np.array(array, dtype=np.float64)


def _along_x(heights: Array, spacing: tuple[float, float]) -> tuple[Array, tuple[float, float]]:
    """A profile as (n, 1), its spacing that between its points."""
    dx, dy = spacing
    return heights.reshape(-1, 1), (dy, dx) if heights.ndim == 2 and heights.shape[0] == 1 else (dx, dy)


def _rough(file: Path, heights: Array, spacing: tuple[float, float], periodic: bool, otherwise: str) -> Rough:
    if heights.size < 2:
        raise InputError(f"{file}: holds {heights.size} points; a profile has at least 2")
    if not np.isfinite(heights).all():
        count = int((~np.isfinite(heights)).sum())
        raise InputError(f"{file}: has {count} heights that are not finite; fill them first")
    surface = Surface(heights=np.repeat(heights, 2, axis=1), spacing=spacing)
    return Rough(
        heights=heights,
        spacing=spacing,
        source={"file": file.name, "sha256": hashlib.sha256(file.read_bytes()).hexdigest(), "format": "npy"},
        warnings=joint_warnings(file, surface, otherwise, measured=False) if periodic else (),
    )


def joint_warnings(file: Path, surface: Surface, otherwise: str = "", *, measured: bool) -> tuple[str, ...]:
    """What must be known of a surface that will be repeated and is not periodic by itself."""
    if surface.periodic:
        return ()
    mismatch = periodicity_mismatch(surface)
    remedy = f"roughfilm surface {file} --out S.h5 prepares it{otherwise}"
    if mismatch > MISMATCH_THRESHOLD:
        return (f"{file}: is not periodic (mismatch {mismatch:.2g}), so that its edges meet in steps; {remedy}",)
    if measured:
        return (f"{file}: is taken as it was measured, with its form and without preparation; {remedy}",)
    return ()
