"""Descriptions of random surfaces from measured ones."""

import os
from collections.abc import Mapping
from pathlib import Path

from roughfilm.contact.fitting.text import DESCRIPTION, description_text
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.fitting.run import AREA, COUNT, SEEDS, Fit, fit_windows
from roughfilm.interface.recipes import steps_of
from roughfilm.rom.ladder.model import Progress, silent
from roughfilm.words.fit import notes


def fit_description(
    surface: Surface | str | Path,
    *,
    windows: int = COUNT,
    size: float | None = None,
    area: float = AREA,
    seeds: int = SEEDS,
    recipe: str | Path | Mapping[str, object] | None = None,
    out: str | Path | None = None,
    progress: Progress = silent,
) -> Fit:
    """Fit a random description to the windows of a surface, and test it with windows that were not fitted.

    Windows of one size are prepared as periodic cells. The description is a random field with the mean spectrum of the
    windows; the powers of its octaves and its height distribution differ from seed to seed as they do between windows.
    One half of the windows is fitted and the other half is compared with the 95 % intervals of seeds, then the other
    way round; the description returned is fitted to all windows.

    Parameters
    ----------
    surface : a measured surface, or the TOML file of a description, whose seeds are then the windows.
    windows : number of windows, 16 or more.
    size : side of the windows, m; by default that of the largest squares that fit without overlap.
    area : mean contact area fraction at which windows and seeds are compared, 0.001 to 0.9.
    seeds : number of seeds of each of the three fits, 40 to 10 000.
    recipe : TOML file or nested entries of the preparation of each window; by default they keep their pixels.
    out : TOML file for the description, which any command takes as a surface.
    progress : called with the done fraction and a few words.

    Returns
    -------
    Fit
        ``description``; ``held`` by quantity ("contact pressure", "mean gap", "leakage along x", "leakage along y")
        with the numbers ``inside``, ``below`` and ``above`` the interval of ``count`` held-out windows; ``findings``,
        sentences with ``lacking`` for what the description does not contain; ``warnings``; ``surface_of(seed)``, a
        Surface.

    Raises
    ------
    InputError
        If there are too few windows, or an argument is out of range.
    ConvergenceError
        If no window has a contact.

    References
    ----------
    Schreiber and Schmitz, doi:10.1103/PhysRevLett.77.635 (random fields with given spectrum and heights).

    Examples
    --------
    >>> import numpy as np
    >>> import roughfilm as rf
    >>> noise = np.fft.rfft2(np.random.default_rng(1).standard_normal((128, 128)))
    >>> waves = np.hypot(np.fft.fftfreq(128, 1 / 128)[:, None], np.arange(65)[None, :])
    >>> heights = 1e-8 * np.fft.irfft2(noise * np.exp(-((waves / 16) ** 2)))
    >>> measured = rf.Surface(heights=heights, spacing=(1e-6, 1e-6))
    >>> fit = rf.fit_description(measured, windows=16, size=32e-6, seeds=40)
    >>> fit.held["contact pressure"].count, fit.surface_of(7).shape
    (16, (32, 32))
    """
    if isinstance(surface, str | os.PathLike):
        given: Surface | Path = Path(surface)
        if Path(surface).suffix.lower() != ".toml":
            raise InputError(f"surface: got {str(surface)!r:.60}; read a measured surface by read_surface()")
        if recipe is not None:
            raise InputError("recipe: a description is periodic and needs no preparation; leave it out")
    elif isinstance(surface, Surface):
        given = surface
    else:
        raise InputError(f"surface: got {type(surface).__name__}; give a Surface, such as read_surface() returns")
    steps = steps_of(recipe)
    if not isinstance(out, str | os.PathLike | None):
        raise InputError(f"out: got {type(out).__name__}; give the name of a file")
    name = given.name if isinstance(given, Path) else str(given.source.get("file", "surface"))
    fit = fit_windows(given, steps, count=windows, size=size, area=area, seeds=seeds, name=name, progress=progress)
    if out is not None:
        with replacing(Path(out), DESCRIPTION) as scratch:
            scratch.write_text(description_text(fit.description, notes(fit)), encoding="utf-8")
    return fit
