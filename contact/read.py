"""Readers of the heights of a surface from a measured, stored or synthetic surface or from an array of heights."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.reading.regular import file_size
from roughfilm.contact.foundation.units import to_si
from roughfilm.contact.foundation.writing.kinds import as_input
from roughfilm.contact.surfaces.files import read_measurement
from roughfilm.contact.surfaces.periodicity import not_periodic
from roughfilm.contact.surfaces.plausibility import implausible, preparation_doubts, repeated_extreme
from roughfilm.contact.surfaces.profile import Profile
from roughfilm.contact.surfaces.store import is_surface
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.description import make, read_description


@dataclass(frozen=True, kw_only=True)
class HeightMap:
    """The heights of a surface or a profile, in the form that computations use.

    Attributes
    ----------
    heights : shape (nx, ny), m; ny = 1 for a profile.
    spacing : (dx, dy) of the points, m.
    source : origin of the heights, as entries that JSON can hold.
    warnings : sentences on the limits of a computation with these heights.
    """

    heights: Array
    spacing: tuple[float, float]
    source: Mapping[str, Any]
    warnings: tuple[str, ...]


def parse_spacing(text: str | None) -> tuple[float, float] | None:
    """Convert a text such as "1um" or "1um,2um" to the spacing (dx, dy), m; None gives None.

    Raises
    ------
    InputError
        If the text is not one or two lengths above 0.
    """
    if text is None:
        return None
    parts = text.split(",")
    try:
        lengths = [to_si(part.strip(), "m") for part in parts]
    except ValueError as error:
        raise InputError(f"spacing {text}: {error}") from None
    if len(lengths) > 2 or not min(lengths) > 0:
        raise InputError(f"spacing {text}: give one length above 0 or two, such as 1um or 1um,2um")
    return lengths[0], lengths[-1]


def read_height_map(
    file: Path, spacing: tuple[float, float] | None, *, periodic: bool, otherwise: str = ""
) -> HeightMap:
    """Read the heights in a file, without any preparation.

    Parameters
    ----------
    file : an instrument's file, a stored surface (HDF5), a description of a synthetic one (TOML), or heights (NPY).
    spacing : (dx, dy) of the points of an array of heights, m; None for files that contain the spacing.
    periodic : whether the computation repeats the surface; if so, a surface whose opposite edges differ gets a warning.
    otherwise : a remedy other than the preparation of the surface, which is added to the warnings.

    Raises
    ------
    InputError
        If the file holds no surface, its spacing is missing or given twice, or it has invalid points.
    """
    suffix = as_input(file).suffix.lower()
    file_size(file, "name a surface")
    described = suffix == ".toml" or is_surface(file)
    if described and spacing is not None:
        raise InputError(f"spacing: {file} says its spacing itself; leave it out")
    if suffix == ".npy" and not described and spacing is None:
        raise InputError(f"spacing: {file} holds none; give that of its points, such as 1um")
    if suffix == ".toml":
        surface = make(read_description(file))
    else:
        try:
            found = read_measurement(file, spacing=spacing)
        except InputError as error:
            remedy = " in a recipe of roughfilm surface, and take the surface that it writes"
            raise InputError(str(error).replace(" in the recipe", remedy)) from None
        if isinstance(found, Profile):
            return _profile_map(file, found, periodic, otherwise)
        surface = found
    if surface.invalid.any():
        count = int(surface.invalid.sum())
        raise InputError(f"{file}: has {count} invalid points; fill them: roughfilm surface {file} --out S.h5")
    return HeightMap(
        heights=surface.heights,
        spacing=surface.spacing,
        source=surface.source,
        warnings=(
            *implausible(surface, file),
            *repeated_extreme(surface, file),
            *preparation_doubts(surface, file),
            *(
                periodicity_warnings(file, surface, otherwise, measured=not described and suffix != ".npy")
                if periodic
                else ()
            ),
        ),
    )


def _profile_map(file: Path, profile: Profile, periodic: bool, otherwise: str) -> HeightMap:
    if profile.source["filled"]:
        raise InputError(f"{file}: has {profile.source['filled']} invalid points; fill them first")
    heights, spacing = profile.heights.reshape(-1, 1), (profile.spacing, profile.spacing)
    surface = Surface(heights=np.repeat(heights, 2, axis=1), spacing=spacing, source=profile.source)
    return HeightMap(
        heights=heights,
        spacing=spacing,
        source=profile.source,
        warnings=(
            *implausible(surface, file),
            *repeated_extreme(surface, file),
            *(periodicity_warnings(file, surface, otherwise, measured=False) if periodic else ()),
        ),
    )


def periodicity_warnings(file: Path, surface: Surface, otherwise: str = "", *, measured: bool) -> tuple[str, ...]:
    """The warnings about a surface that a computation repeats although it is not periodic; empty if it is periodic.

    Parameters
    ----------
    file : the file of the surface, for the messages.
    surface : the surface.
    otherwise : a remedy other than the preparation of the surface.
    measured : whether the surface is a measured one, which has form and noise.
    """
    if surface.periodic:
        return ()
    remedy = f"roughfilm surface {file} --out S.h5 prepares it{otherwise}"
    if found := not_periodic(surface, file, remedy):
        return found
    if measured:
        return (f"{file}: is taken as it was measured, with its form and without preparation; {remedy}",)
    return ()
