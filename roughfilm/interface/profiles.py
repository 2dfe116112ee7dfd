"""Profiles from files: their preparation, and surfaces that have their spectrum."""

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from roughfilm.contact.fitting import profile as fitting
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.ranges import in_range
from roughfilm.contact.preparation.profile import prepare_profile
from roughfilm.contact.surfaces.files import by_arguments, read_measurement
from roughfilm.contact.surfaces.profile import Profile
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.description import make
from roughfilm.interface.recipes import steps_of
from roughfilm.interface.surfaces import codes_of


def read_profile(
    path: str | Path,
    *,
    spacing: float | None = None,
    channel: str | None = None,
    height_unit: str | None = None,
    invalid: float | Sequence[float] = (),
    recipe: str | Path | Mapping[str, Any] | None = None,
) -> Profile:
    """Read a profile from a file, and remove its form and waves by a recipe.

    Parameters
    ----------
    path : NPY or CSV file of one line of heights, CSV file of x, z, or file of an instrument.
    spacing : distance of neighbouring points, m, if the file does not hold it.
    channel : name of the channel, if the file of an instrument holds several.
    height_unit : unit of the heights, such as "um", if the file does not hold it; m for NPY.
    invalid : heights that mark missing points, such as -9999 or 0, in the unit of the file.
    recipe : TOML file or nested entries with ``form``, ``s_filter`` (λs) and ``l_filter`` (λc); by default the heights
        stay as measured.

    Returns
    -------
    Profile
        ``heights``, shape (n,), m, ``spacing``, m, and ``length``, m. Heights of missing points are interpolated;
        ``source["filled"]`` is their number.

    Raises
    ------
    InputError
        If the file is missing, damaged or incomplete, or holds a surface, or another argument is out of range.
    UnavailableError
        If the file needs a library that is not installed.

    Examples
    --------
    >>> import tempfile
    >>> import numpy as np
    >>> import roughfilm as rf
    >>> with tempfile.TemporaryDirectory() as directory:
    ...     np.save(f"{directory}/line.npy", 1e-6 * np.sin(np.arange(500) / 10))
    ...     profile = rf.read_profile(f"{directory}/line.npy", spacing=1e-6)
    >>> round(1e6 * rf.profile_parameters(profile.heights, spacing=profile.spacing)["Rq"].value, 2)
    0.71
    """
    if not isinstance(path, str | os.PathLike):
        raise InputError(f"path: got {type(path).__name__}; name a file; heights in an array need no reading")
    step = None if spacing is None else in_range("spacing", spacing, "m")
    try:
        found = read_measurement(
            Path(path),
            channel=channel,
            spacing=None if step is None else (step, step),
            height_unit=height_unit,
            invalid=codes_of(invalid),
        )
    except InputError as error:
        raise by_arguments(error) from None
    if isinstance(found, Surface):
        raise InputError(
            f"{path}: is a surface of {found.shape[0]} x {found.shape[1]} points; read it by read_surface()"
        )
    return found if recipe is None else prepare_profile(found, steps_of(recipe))


def fit_profile(profile: Profile, *, anisotropy: float = 1.0, seed: int = 0) -> Surface:
    """Make a periodic surface whose profiles have the spectrum and the heights of a measured one.

    The waves of the surface have the power p(√(m² + n²)) with P(m) = Σ_n p(√(m² + n²)), where P(m) is the power of the
    waves of the profile in sections as long as the period of the surface.

    Parameters
    ----------
    profile : roughness, without form, measured along x.
    anisotropy : length of ridges, along y, over their width; 1 for an isotropic surface.
    seed : number of the surface; seeds differ by chance alone, not as windows of a measured surface do.

    Returns
    -------
    Surface : as long as a fifth of the profile, or less with more than 5120 points.

    Raises
    ------
    InputError
        If the profile has fewer than 160 points, all its heights are the same, or another argument is out of range.

    References
    ----------
    P. R. Nayak, J. Lubr. Technol. 93 (1971) 398.

    Examples
    --------
    >>> import numpy as np
    >>> import roughfilm as rf
    >>> from roughfilm.contact.surfaces.profile import Profile
    >>> z = 1e-6 * np.convolve(np.random.default_rng(1).standard_normal(1007), np.ones(8) / 8, "valid")
    >>> surface = rf.fit_profile(Profile(heights=z, spacing=1e-6))
    >>> surface.shape, surface.periodic
    ((200, 200), True)
    """
    if not isinstance(profile, Profile):
        raise InputError(f"profile: got {type(profile).__name__}; give a Profile, such as read_profile() returns")
    return make(fitting.fit_profile(profile, anisotropy=anisotropy).model_copy(update={"seed": seed}))
