"""Rough surfaces from arrays and files: preparation, roughness parameters, dry contact and flow factors."""

import math
import os
import warnings
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Literal, cast, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from roughfilm.contact.foundation.arrays import finite_arithmetic, unmasked
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.ranges import in_range
from roughfilm.contact.foundation.units import Quantity
from roughfilm.contact.mechanics.contact import Contact
from roughfilm.contact.mechanics.half_space import Boundary
from roughfilm.contact.mechanics.press import COMPLEMENTARITY_TOLERANCE, Press
from roughfilm.contact.mechanics.solid import Solid, beyond_elasticity, composite_modulus
from roughfilm.contact.parameters import roughness_parameters
from roughfilm.contact.parameters.profile import SECTIONS
from roughfilm.contact.preparation import prepare as preparation
from roughfilm.contact.preparation.recipe import AS_IT_IS
from roughfilm.contact.registration import combine as combination
from roughfilm.contact.surfaces import files
from roughfilm.contact.surfaces.periodicity import not_periodic
from roughfilm.contact.surfaces.plausibility import implausible, repeated_extreme
from roughfilm.contact.surfaces.surface import MAX_LENGTH, Surface
from roughfilm.contact.synthetic.description import make, read_description
from roughfilm.interface.cells import CellSet, checked_windows
from roughfilm.interface.recipes import steps_of
from roughfilm.rom.homogenization.table.windows import factors_at, point_quantities
from roughfilm.rom.ladder.model import Progress, silent

Heights = ArrayLike | Surface


def surface_of(heights: Heights, spacing: float | Sequence[float] | None) -> Surface:
    """The surface with checked heights, m, on a uniform grid.

    Raises InputError unless the heights are finite real numbers of shape (nx, ny) with nx, ny >= 2.
    """
    if isinstance(heights, Surface):
        if spacing is not None:
            raise InputError(f"spacing: got {spacing!r}; the surface has {heights.spacing} m, leave it out")
        if heights.invalid.any():
            count = int(heights.invalid.sum())
            raise InputError(f"heights: {count} of {heights.invalid.size} points are invalid; fill them by prepare()")
        return heights
    array = _real_numbers(heights, "an array of shape (nx, ny)", ", by prepare() of a Surface with these heights")
    if len(places := np.argwhere(~np.isfinite(array))):
        remedy = "give finite heights, or a Surface with these points as invalid to prepare()"
        raise InputError(
            f"heights: {len(places)} of {array.size} points are not finite, the first at {places[0].tolist()}; {remedy}"
        )
    if spacing is None:
        raise InputError("spacing: missing; give the distance of neighbouring points in m, or a pair (dx, dy)")
    return Surface(heights=array, spacing=_pair(spacing))


def _real_numbers(heights: ArrayLike, form: str, remedy: str = "") -> NDArray[Any]:
    """The heights as an array without masked points; raises InputError with the form or the remedy otherwise."""
    try:
        array = unmasked("heights", heights)
    except InputError as error:
        raise InputError(f"{error}{remedy}") from None
    except ValueError:
        raise InputError(f"heights: got rows of different lengths; give {form}") from None
    if array.dtype.kind not in "fiu":
        raise InputError(f"heights: got an array of {array.dtype}; give real numbers in m")
    return array


def _pair(spacing: float | Sequence[float]) -> tuple[float, float]:
    try:
        dx, dy = np.broadcast_to(np.asarray(spacing, dtype=float), (2,))
    except (TypeError, ValueError, OverflowError):
        raise InputError(f"spacing: got {spacing!r:.60}; give one length in m, or a pair (dx, dy)") from None
    return float(dx), float(dy)


def read_surface(
    path: str | Path,
    *,
    spacing: float | Sequence[float] | None = None,
    channel: str | None = None,
    height_unit: str | None = None,
    invalid: float | Sequence[float] = (),
) -> Surface:
    """Read a measured surface from a file, or generate the synthetic surface that a TOML file describes.

    Parameters
    ----------
    path : HDF5 file of this package, NPY, CSV or TOML file, or file of an instrument (with the extra ``instruments``).
    spacing : distance of neighbouring points, m, or a pair (dx, dy), if the file does not hold it.
    channel : name of the channel, if the file of an instrument holds several.
    height_unit : unit of the heights, such as "um", if the file does not hold it; m for NPY.
    invalid : heights that mark missing points, such as -9999 or 0, in the unit of the file.

    Returns
    -------
    Surface
        Heights in m, shape (nx, ny), with invalid points marked.

    Raises
    ------
    InputError
        If the file is missing, damaged or incomplete; the one-line message gives the remedy.
    UnavailableError
        If the file needs a library that is not installed.

    Warns
    -----
    UserWarning
        If a unit of the file may be wrong: pixels outside of 0.05 nm to 1 mm, an rms slope of 3 or more, or an rms
        height outside of 10⁻⁵ to 10³ pixels; if many points share one extreme height, which may mark missing points.

    Examples
    --------
    >>> import roughfilm as rf
    >>> surface = rf.read_surface("scripts/examples/surfaces/milled.toml")
    >>> surface.shape, surface.periodic
    ((512, 384), True)
    """
    if not isinstance(path, str | os.PathLike):
        raise InputError(f"path: got {type(path).__name__}; name a file; heights in an array need no reading")
    file = Path(path)
    codes = codes_of(invalid)
    if file.suffix.lower() == ".toml":
        given = {"spacing": spacing, "channel": channel, "height_unit": height_unit, "invalid": codes or None}
        for name in (name for name, value in given.items() if value is not None):
            raise InputError(f"{name}: got {given[name]!r}; a described surface is complete, leave it out")
        return make(read_description(file))
    pair = None if spacing is None else _pair(spacing)
    try:
        surface = files.read_surface(file, channel=channel, spacing=pair, height_unit=height_unit, invalid=codes)
    except InputError as error:
        raise files.by_arguments(error) from None
    for sentence in (*implausible(surface, file), *repeated_extreme(surface, file)):
        warnings.warn(sentence, UserWarning, stacklevel=2)
    return surface


def codes_of(invalid: float | Sequence[float]) -> tuple[float, ...]:
    """The heights that mark missing points; raises InputError unless they are numbers."""
    try:
        return tuple(np.asarray(invalid, dtype=float).ravel().tolist())
    except (TypeError, ValueError, OverflowError):
        raise InputError(f"invalid: got {invalid!r:.60}; give a height, or a list of them") from None


def prepare(surface: Surface, recipe: str | Path | Mapping[str, Any] | None = None) -> preparation.Prepared:
    """Prepare a measured surface as a periodic cell: level, cut outliers, fill, window, resample, join edges, smooth.

    Parameters
    ----------
    surface : the measured surface.
    recipe : TOML file or nested entries with the parameters of each step. There is a default recipe; without a recipe
        a surface that is already periodic is only checked.

    Returns
    -------
    Prepared
        ``surface`` is the periodic cell, ``warnings`` are sentences on possible deviations of the cell from the
        measured surface, and ``record`` lists the changes by each step.

    Raises
    ------
    InputError
        If a step cannot be done; the one-line message names the step.
    ConvergenceError
        If invalid points cannot be filled to tolerance.

    References
    ----------
    F. Sahlin, Lubrication, contact mechanics and leakage between rough surfaces, Luleå 2008, sections E.3.1 and F.3.

    Examples
    --------
    >>> import numpy as np
    >>> import roughfilm as rf
    >>> measured = rf.Surface(heights=1e-6 * np.random.default_rng(1).normal(size=(60, 50)), spacing=(1e-6, 1e-6))
    >>> prepared = rf.prepare(measured, {"edges": {"direction": "both"}})
    >>> prepared.surface.shape, prepared.record["edges"]["direction"]
    ((60, 50), 'both')
    """
    if not isinstance(surface, Surface):
        raise InputError(f"surface: got {type(surface).__name__}; give a Surface, such as read_surface() returns")
    return preparation.prepare(surface, steps_of(recipe, AS_IT_IS if surface.periodic else None))


def combine(
    first: Surface,
    second: Surface,
    operation: combination.Operation = "difference",
    *,
    recipe: str | Path | Mapping[str, Any] | None = None,
    shift: Sequence[float] | str | None = None,
    level: combination.Level = "unworn",
    mirror: combination.Mirror = "y",
) -> combination.Combined:
    """Subtract two measurements of one place, which shows wear, or add two walls that face each other.

    Both are brought to the larger pixel spacing. The second is placed on the first by cross-correlation, to a fraction
    of a pixel, or by a given shift; the common valid points are kept. A difference is first − second, before − after,
    above a plane through the unworn points. A sum is h₁(x, y) + h₂(x, L_y − y): the second wall is turned over about
    its x axis, so that both walls face each other; it serves as one rough wall against a plane.

    Parameters
    ----------
    first, second : the measurements, before and after, or two walls.
    operation : "difference" or "sum".
    recipe : TOML file or nested entries, of which both take form, outliers and filters first; by default the tilt, and
        nothing from two periodic surfaces.
    shift : position (x, y) of the first pixel of the second surface on the first one, m, or "registered"; by default
        "registered" for a difference and (0, 0) for a sum. Two walls are registered where they interlock best.
    level : whether the plane is fitted to the "unworn" points or to "all".
    mirror : coordinate of the second wall that is reversed: "y", "x" or "none".

    Returns
    -------
    Combined
        ``surface`` is the difference or the sum, ``first`` and ``second`` are both on its grid, ``quantities`` have
        ``shift_x``, ``shift_y``, ``correlation`` and ``common_fraction``, of a difference ``worn_volume_per_area``,
        ``largest_depth``, ``worn_fraction`` and ``noise``, of a sum ``Sq_first``, ``Sq_second`` and ``Sq_sum``.
        ``warnings`` are sentences, such as on a correlation that unrelated surfaces have as well.

    Raises
    ------
    InputError
        For an argument out of range, surfaces without a common part, or constant heights.
    ConvergenceError
        If invalid points cannot be filled to tolerance.

    Notes
    -----
    The registration finds no rotation and no difference in magnification.

    References
    ----------
    D. Padfield, IEEE Trans. Image Process. 21 (2012) 2706.

    Examples
    --------
    >>> import numpy as np
    >>> import roughfilm as rf
    >>> heights = 1e-6 * np.random.default_rng(1).normal(size=(80, 70))
    >>> before = rf.Surface(heights=heights[:64, :64], spacing=(1e-6, 1e-6))
    >>> after = rf.Surface(heights=heights[9:73, 4:68], spacing=(1e-6, 1e-6))
    >>> moved = rf.combine(before, after).quantities
    >>> round(1e6 * moved["shift_x"].value, 6), round(1e6 * moved["shift_y"].value, 6)
    (9.0, 4.0)
    """
    for name, surface in (("first", first), ("second", second)):
        if not isinstance(surface, Surface):
            raise InputError(f"{name}: got {type(surface).__name__}; give a Surface, such as read_surface() returns")
    if not isinstance(operation, str) or operation not in get_args(combination.Operation):
        raise InputError(f"operation: got {operation!r:.60}; it must be 'difference' or 'sum'")
    if not isinstance(level, str) or level not in get_args(combination.Level):
        raise InputError(f"level: got {level!r:.60}; it must be 'unworn' or 'all'")
    if not isinstance(mirror, str) or mirror not in get_args(combination.Mirror):
        raise InputError(f"mirror: got {mirror!r:.60}; it must be 'x', 'y' or 'none'")
    steps = steps_of(recipe, combination.usual_entries(first, second))
    place = _place("registered" if shift is None and operation == "difference" else shift)
    with finite_arithmetic("combine"):
        if operation == "sum":
            return combination.composite(first, second, steps, shift=place, mirror=mirror)
        return combination.difference(first, second, steps, shift=place, level=level)


def _place(shift: Sequence[float] | str | None) -> combination.Shift:
    if isinstance(shift, str) and shift == "registered":
        return "registered"
    try:
        x, y = (0.0, 0.0) if shift is None else map(float, shift)
    except (TypeError, ValueError):
        raise InputError(f"shift: got {shift!r:.60}; give a pair (x, y) in m, or 'registered'") from None
    if not all(math.isfinite(length) and abs(length) < MAX_LENGTH for length in (x, y)):
        raise InputError(f"shift: got {shift!r:.60}; give a pair (x, y) in m below {MAX_LENGTH:g}")
    return x, y


def parameters(heights: Heights, *, spacing: float | Sequence[float] | None = None) -> dict[str, Quantity]:
    """Compute the areal roughness parameters of ISO 25178-2 from heights relative to their mean.

    The heights are neither filtered nor levelled: values are comparable between laboratories only with the nesting
    indices of the filters before (`prepare`). `roughfilm.contact.parameters.definitions.AREAL` defines each parameter.

    Parameters
    ----------
    heights : z, shape (nx, ny), m, upward; or a Surface, whose valid points count.
    spacing : distance of neighbouring points, m, or a pair (dx, dy); not for a Surface.

    Returns
    -------
    dict of Quantity
        Heights Sa, Sq, Sp, Sv, Sz, St in m and Ssk, Sku without unit; of the bearing curve Sk, Spk, Svk, Sxp in m and
        Smr1, Smr2 without unit; volumes Vmp, Vmc, Vvc, Vvv in m (m³/m²); slopes Sdq, Sdr without unit; Sal in m, Str
        without unit, Std in degrees; of peaks and pits Spd in 1/m², Spc in 1/m, S5p, S5v, S10z, Spm, Svm in m. Their
        uncertainty is unknown. Spc, S5p, S5v and S10z are left out if no hill or dale lies inside the edges, Sdq and
        Sdr if no valid points are neighbours.

    Raises
    ------
    InputError
        If the heights are not finite numbers on at least 2 x 2 points, or are all equal.

    Notes
    -----
    The errors are of second order in the spacing; that of Spc is of first order where peaks are not symmetric.

    References
    ----------
    ISO 25178-2:2021, with material ratios of 10 % and 80 % and a Wolf pruning of 5 % of Sz.

    Examples
    --------
    >>> import numpy as np
    >>> import roughfilm as rf
    >>> wave = 1e-6 * np.sin(2 * np.pi * np.arange(64) / 64)
    >>> sq = rf.parameters(np.tile(wave, (64, 1)), spacing=1e-6)["Sq"]
    >>> round(1e6 * sq.value, 4), sq.unit
    (0.7071, 'm')
    """
    surface = heights if isinstance(heights, Surface) and spacing is None else surface_of(heights, spacing)
    return roughness_parameters.parameters(surface)


def profile_parameters(
    heights: ArrayLike,
    *,
    spacing: float,
    sections: int = SECTIONS,
    profile: Literal["P", "W", "R"] = "R",
) -> dict[str, Quantity]:
    """Compute the parameters of ISO 21920-2 of one profile from heights relative to their mean.

    The heights are neither filtered nor levelled. `roughfilm.contact.parameters.definitions.PROFILE` defines each
    parameter.

    Parameters
    ----------
    heights : z, shape (n,), m, upward, equidistant.
    spacing : distance of neighbouring points, m.
    sections : number of section lengths over which Rp, Rv and Rz are averaged, 1 to n; all others are those of the
        whole profile.
    profile : first letter of the names: P of a primary profile, W of a waviness profile, R of a roughness profile.

    Returns
    -------
    dict of Quantity
        Ra, Rq, Rt, Rp, Rv, Rz, Rk, Rpk, Rvk, Rsm, Rc in m; Rsk, Rku, Rmr1, Rmr2, Rdq without unit. Their uncertainty is
        unknown. Rsm and Rc are left out if the profile has no complete element, a hill and a dale.

    Raises
    ------
    InputError
        If the heights are not finite numbers in one line, or all equal, or another argument is out of range.

    References
    ----------
    ISO 21920-2:2021.

    Examples
    --------
    >>> import numpy as np
    >>> import roughfilm as rf
    >>> wave = 1e-6 * np.sin(2 * np.pi * np.arange(1000) / 100)
    >>> found = rf.profile_parameters(wave, spacing=1e-6)
    >>> round(1e6 * found["Rz"].value, 4), round(1e6 * found["Rsm"].value, 4)
    (2.0, 100.0)
    """
    line = _real_numbers(heights, "one line of them")
    return roughness_parameters.profile_parameters(
        line, in_range("spacing", spacing, "m"), sections=sections, profile=profile
    )


def press(
    heights: Heights,
    *,
    spacing: float | Sequence[float] | None = None,
    modulus: float,
    load: float,
    poisson: float = 0.3,
    hardness: float = math.inf,
    boundary: Boundary = "periodic",
    tolerance: float = COMPLEMENTARITY_TOLERANCE,
    threads: int = 1,
) -> Contact:
    """Press a rough surface against a rigid plane, elastic or elastic-plastic, without friction or adhesion.

    The unknowns are the pressure p, 0 <= p <= H, with the mean W, and the deformed gap h + K∗p − g, which is 0 where
    0 < p < H and >= 0 where p = 0. K is the response of an elastic half-space with the modulus E* = E/(1 − ν²). For an
    elastic plane with the composite modulus E*, set ``modulus`` to E = (1 − ν²) E*.

    Parameters
    ----------
    heights : z, shape (nx, ny), m, upward, towards the plane; or a Surface.
    spacing : distance of neighbouring points, m, or a pair (dx, dy); not for a Surface.
    modulus : Young's modulus E, Pa.
    load : mean pressure W over the nominal area, Pa, above 0 and at most the hardness.
    poisson : Poisson's ratio ν, 0 to 0.5.
    hardness : greatest pressure H, Pa; infinite for an elastic surface.
    boundary : "periodic", or "free" for a surface that stands alone on the half-space.
    tolerance : greatest violation of the contact conditions over the rms height, 1e-13 to 1.
    threads : number of threads, 1 or more.

    Returns
    -------
    Contact
        It has the floats ``area_fraction`` (corrected for the pixels along a smooth perimeter),
        ``area_fraction_pixel`` (counted), ``plastic_fraction``, ``mean_gap`` (m), ``approach`` (m), and arrays of shape
        (nx, ny) ``pressure`` (Pa), ``gap`` (m), ``in_contact``. ``complementarity`` is the violation of the
        contact conditions, recomputed from the pressure. One grid does not give the discretisation error; compare two
        grids. If the shortest wave is resolved, the area converges with first order in the spacing, gap and approach
        with second.

    Raises
    ------
    InputError
        For an argument out of range, or heights that are not finite numbers of shape (nx, ny).
    ConvergenceError
        If the contact conditions stay violated by more than the tolerance.

    Warns
    -----
    UserWarning
        If the peak pressure exceeds 0.3 E*, beyond which linear elasticity does not hold, or if opposite edges of a
        surface that is repeated meet in steps.

    References
    ----------
    F. Sahlin, Luleå 2008, section E.2.2; V. A. Yastrebov et al., doi:10.1016/j.triboint.2017.04.023 (area
    fraction).

    Examples
    --------
    >>> import numpy as np
    >>> import roughfilm as rf
    >>> wave = 1e-6 * np.cos(2 * np.pi * np.arange(32) / 32)
    >>> contact = rf.press(np.add.outer(wave, wave), spacing=1e-6, modulus=210e9, load=1e9)
    >>> contact.pressure.shape, round(contact.area_fraction, 2)
    ((32, 32), 0.06)
    """
    surface = surface_of(heights, spacing)
    solid = Solid(
        modulus=in_range("modulus", modulus, "Pa"),
        poisson=in_range("poisson", poisson, "1", zero=True),
        hardness=hardness if hardness == math.inf else in_range("hardness", hardness, "Pa"),
    )
    pressure, accuracy = in_range("load", load, "Pa"), in_range("tolerance", tolerance, "1")
    with finite_arithmetic("press"):
        body = Press(
            surface.heights,
            surface.spacing,
            composite_modulus(solid),
            hardness=solid.hardness,
            boundary=boundary,
            threads=threads,
        )
        contact = body.at(pressure, tolerance=accuracy)
    edges = not_periodic(surface, "heights", "prepare() joins its edges") if boundary == "periodic" else ()
    for sentence in (*edges, *beyond_elasticity(float(contact.pressure.max()), body.composite_modulus)):
        warnings.warn(sentence, UserWarning, stacklevel=2)
    return contact


def flow_factors(
    heights: Heights | CellSet | Sequence[Surface],
    *,
    spacing: float | Sequence[float] | None = None,
    gap: float,
    offset: float = 0.0,
    progress: Progress = silent,
) -> dict[str, Quantity]:
    """Compute the flow factors of the film between a rough surface and a smooth one at one mean gap.

    With the rough wall at rest and the smooth one sliding along x at u, the averaged flow per width is
    q = (u/2) ĥ B − ĥ³ A∇p/(12η) and the shear stress on the sliding wall τ = (ηu/ĥ)(d + 3e) + ĥ B·∇p/2, with ĥ the mean
    gap; a smooth film has A = 1, B = (1, 0), d = 1, e = 0. Heights that reach the smooth wall are cut off.

    Parameters
    ----------
    heights : z, shape (nx, ny), m, upward, towards the smooth wall, one period; or a Surface; or several windows, as
        :func:`roughfilm.windows` returns them, or a list of Surfaces.
    spacing : distance of neighbouring points, m, or a pair (dx, dy); not for a Surface.
    gap : mean gap ĥ, m, before the offset.
    offset : length added to the gap everywhere, m; 0 closes the film where the walls touch.
    progress : called with the done fraction and a few words.

    Returns
    -------
    dict of Quantity
        A11, A12, A21, A22, B1, B2, d, e with their uncertainties (None if unknown), ``mean_gap`` and ``separation``
        (the distance of the mean planes), both in m, and ``contact``, the area fraction in contact. A direction whose A
        is 0 is sealed. Over several windows of this mean gap they are means; A11 to e then have ``scatter``, the half
        width of their 95 % confidence interval from how the windows differ, and ``window_interval``, that for one.

    Raises
    ------
    InputError
        For an argument out of range, or heights that are not finite numbers of shape (nx, ny).
    ConvergenceError
        If a cell problem does not converge.

    Warns
    -----
    UserWarning
        If opposite edges of a surface meet in steps.

    Notes
    -----
    The error is of second order in the spacing where the gap is smooth and open, and of nearly first order at the edges
    of contact.

    References
    ----------
    F. Sahlin, Luleå 2008, papers C and E; doi:10.1016/j.triboint.2006.02.069.

    Examples
    --------
    For transverse ridges A11 = 1/(ĥ³<h⁻³>) and A22 = <h³>/ĥ³.

    >>> import numpy as np
    >>> import roughfilm as rf
    >>> ridges = np.outer(1e-6 * np.cos(2 * np.pi * np.arange(64) / 64), np.ones(64))
    >>> factors = rf.flow_factors(ridges, spacing=1e-6, gap=3e-6)
    >>> round(factors["A11"].value, 3), round(factors["A22"].value, 3)
    (0.706, 1.167)
    """
    mean_gap, added = in_range("gap", gap, "m"), in_range("offset", offset, "m", zero=True)
    if _are_windows(heights):
        if spacing is not None:
            raise InputError(f"spacing: got {spacing!r}; the windows have their own, leave it out")
        windows = checked_windows(heights)
        surfaces, independent = windows.cells, windows.independent
    else:
        surfaces, independent = (surface_of(cast("Heights", heights), spacing),), None
    steps = (not_periodic(surface, "heights", "prepare() joins its edges") for surface in surfaces)
    for sentence in next(filter(None, steps), ()):
        warnings.warn(sentence, UserWarning, stacklevel=2)
    with finite_arithmetic("flow_factors"):
        point = factors_at(
            [surface.heights for surface in surfaces],
            surfaces[0].spacing,
            mean_gap,
            independent=independent,
            offset=added,
            progress=progress,
        )
    return {
        **point_quantities(point),
        "mean_gap": Quantity(value=point.mean_gap, unit="m"),
        "separation": Quantity(value=point.separation, unit="m"),
        "contact": Quantity(value=point.contact, unit="1"),
    }


def _are_windows(heights: object) -> bool:
    """Whether an argument is a set of windows, or a list whose first entry is a surface."""
    listed = isinstance(heights, list | tuple) and len(heights) > 0 and isinstance(heights[0], Surface)
    return listed or (hasattr(heights, "cells") and hasattr(heights, "independent"))
