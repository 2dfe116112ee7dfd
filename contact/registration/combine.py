"""The difference of two measurements of one place, and the sum of two walls that face each other."""

from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass
from typing import Any, Literal, get_args

import numpy as np

from roughfilm.contact.foundation.arrays import Array, Mask
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.units import Quantity
from roughfilm.contact.preparation.grid import resample
from roughfilm.contact.preparation.prepare import Levelled
from roughfilm.contact.preparation.prepare import level as prepared_level
from roughfilm.contact.preparation.recipe import AS_IT_IS, Recipe, read_recipe, recipe_entries
from roughfilm.contact.registration.grids import Sampler, common_spacing, overlap
from roughfilm.contact.registration.register import Registration, register
from roughfilm.contact.registration.wear import wear_of
from roughfilm.contact.surfaces.plausibility import ROUNDING
from roughfilm.contact.surfaces.surface import Surface

Operation = Literal["difference", "sum"]
Mirror = Literal["x", "y", "none"]
Level = Literal["unworn", "all"]

Shift = tuple[float, float] | Literal["registered"]
"""Position of the first pixel of the second surface on the first one, m, or the one that registration finds."""


MIN_CORRELATION = 0.95
"""Correlation of the unworn points of both measurements below which a difference causes a warning."""

WITHOUT_TILT: Mapping[str, Any] = {**AS_IT_IS, "form": "tilt"}
"""Entries of the recipe of surfaces that are not periodic; its steps up to the window are taken on both."""


@dataclass(frozen=True, kw_only=True)
class Combined:
    """Two surfaces on one grid, and their difference or sum.

    Attributes
    ----------
    operation : "difference" or "sum".
    first, second : both surfaces on the common grid, over the part that they share; the second of a sum is mirrored.
    surface : difference or sum, m; invalid where one of both is. The ``source`` holds those of both and the record.
    worn : mask of the points where the difference exceeds noise; all false for a sum.
    quantities : numbers of the operation, by name.
    record : what was done, as entries that JSON can hold.
    warnings : reasons why the result may be wrong, one sentence each.
    """

    operation: Operation
    first: Surface
    second: Surface
    surface: Surface
    worn: Mask
    quantities: Mapping[str, Quantity]
    record: Mapping[str, Any]
    warnings: tuple[str, ...]


def usual_entries(first: Surface, second: Surface) -> Mapping[str, Any]:
    """The entries of the default recipe: tilt is removed, unless both surfaces are periodic."""
    return AS_IT_IS if first.periodic and second.periodic else WITHOUT_TILT


def difference(
    before: Surface,
    after: Surface,
    recipe: Recipe | None = None,
    *,
    shift: Shift = "registered",
    level: Level = "unworn",
) -> Combined:
    """The difference before − after of two measurements of one place: positive where material is gone.

    The surfaces are resampled to the larger of their pixel spacings, registered (`register`), and subtracted over the
    points that both have; ``after`` is interpolated by cubic splines. A plane through the unworn points is subtracted
    (`wear_of`).

    Parameters
    ----------
    before, after : the measurements.
    recipe : its form, outliers and filters are taken from both first; by default the tilt. A form of higher order than
        the tilt, and an L-filter, are fitted to the worn place too and make it shallower.
    shift : position of the first pixel of ``after`` on ``before``, m along x and y; by default by registration.
    level : whether the plane is fitted to the "unworn" points or to "all".

    Returns
    -------
    Combined : quantities ``worn_volume_per_area`` (m; mean difference above its level), ``largest_depth`` (m; after a
        Gaussian filter of two pixels), ``worn_fraction``, ``noise`` (m; standard deviation of the difference over the
        unworn points), ``shift_x``, ``shift_y`` (m), ``correlation`` (of both over the points that are not worn), and
        ``common_fraction`` (common valid points over those of the smaller surface). A correlation below 0.95 causes a
        warning.

    Raises
    ------
    InputError
        If the surfaces overlap by fewer than 8 pixels along a side or 100 valid points, or one is constant.
    ConvergenceError
        If the filling of invalid points for the interpolation does not converge.
    """
    recipe = recipe or read_recipe(usual_entries(before, after))
    levelled = [prepared_level(surface, recipe) for surface in (before, after)]
    one, two = common_spacing(*(_open(each.trusted) for each in levelled))
    registration = _registered(one, two, shift)
    first, second = _aligned(one, two, registration.shift)
    valid = first.valid & second.valid
    rounding = ROUNDING * max(float(np.abs(surface.heights[surface.valid]).max()) for surface in (before, after))
    wear = wear_of(first.heights - second.heights, valid, rounding=rounding, unworn_only=level == "unworn")
    quantities = {
        "worn_volume_per_area": Quantity(value=wear.volume, unit="m", uncertainty=wear.volume_uncertainty),
        "largest_depth": Quantity(value=wear.largest, unit="m", uncertainty=wear.largest_uncertainty),
        "worn_fraction": Quantity(value=wear.worn_fraction, unit="1"),
        "noise": Quantity(value=wear.noise, unit="m"),
        **_places(registration, first, second, valid & ~wear.worn, valid, min(one.valid.sum(), two.valid.sum())),
    }
    record = {
        "operation": "difference",
        "level": level,
        **_record(registration, first, recipe, [each.record for each in levelled]),
    }
    return Combined(
        operation="difference",
        first=first,
        second=second,
        surface=_surface(wear.depth, valid, first, record, (before, after)),
        worn=wear.worn,
        quantities=quantities,
        record=record,
        warnings=(
            *_of_both(levelled),
            *registration.warnings,
            *_mismatch(quantities["correlation"].value),
            *wear.warnings,
        ),
    )


def composite(
    first: Surface,
    second: Surface,
    recipe: Recipe | None = None,
    *,
    shift: Shift = (0.0, 0.0),
    mirror: Mirror = "y",
) -> Combined:
    """The composite roughness h₁ + h₂ of two walls that face each other, as one wall against a plane.

    Each wall is measured from above, with heights towards the instrument. To face the first, the second is turned over
    about its x axis: its heights point down and its y axis is reversed. The gap is the distance of the mean planes less
    h₁(x, y) + h₂(x − sₓ, L_y − (y − s_y)), so that the sum has the gap of both walls. In contact both walls share one
    composite modulus.

    Parameters
    ----------
    first, second : the measurements, or periodic cells.
    recipe : its form, outliers and filters are taken from both first; by default the tilt, and nothing from two
        periodic surfaces.
    shift : position of the first pixel of the mirrored second surface on the first one, m; "registered" finds the one
        at which the walls interlock best (the largest correlation of h₁ with −h₂).
    mirror : coordinate of the second surface that is reversed: "y" (turned about x), "x" (turned about y), or "none"
        for a surface that was measured mirrored, such as a replica.

    Returns
    -------
    Combined : quantities ``Sq_first``, ``Sq_second`` and ``Sq_sum`` (m; rms heights over the common points, from the
        mean), ``shift_x``, ``shift_y`` (m), ``correlation`` (of h₁ and the mirrored h₂), and ``common_fraction``. With
        the correlation r, Sq² of the sum is Sq₁² + Sq₂² + 2 r Sq₁ Sq₂. The sum of two periodic surfaces of one size is
        periodic; otherwise it has the common part of both, and ``roughfilm surface`` prepares a cell of it.

    Raises
    ------
    InputError
        If the surfaces overlap by fewer than 8 pixels along a side, or one is constant.
    ConvergenceError
        If the filling of invalid points for the interpolation does not converge.
    """
    if mirror not in get_args(Mirror):
        raise InputError(f"mirror: got {mirror!r}; it must be one of {', '.join(get_args(Mirror))}")
    recipe = recipe or read_recipe(usual_entries(first, second))
    levelled = [prepared_level(surface, recipe) for surface in (first, second)]
    wall, other = (each.trusted for each in levelled)
    turned = {"x": np.s_[::-1, :], "y": np.s_[:, ::-1], "none": np.s_[:, :]}[mirror]
    other = other.with_heights(other.heights[turned], invalid=other.invalid[turned])
    wall, other = _periods(wall, other) or common_spacing(_open(wall), _open(other))
    registration = _registered(wall, other.with_heights(-other.heights), shift)
    smaller = min(wall.valid.sum(), other.valid.sum())
    wall, other = _aligned(wall, other, registration.shift)
    valid = wall.valid & other.valid
    heights = np.where(valid, wall.heights + other.heights, 0.0)
    quantities = {
        **{
            f"Sq_{name}": Quantity(value=float(field[valid].std()), unit="m")
            for name, field in (("first", wall.heights), ("second", other.heights), ("sum", heights))
        },
        **_places(registration, wall, other, valid, valid, smaller),
    }
    record = {
        "operation": "sum",
        "mirror": mirror,
        **_record(registration, wall, recipe, [each.record for each in levelled]),
    }
    return Combined(
        operation="sum",
        first=wall,
        second=other,
        surface=_surface(heights, valid, wall, record, (first, second)),
        worn=np.zeros(valid.shape, dtype=bool),
        quantities=quantities,
        record=record,
        warnings=(*_of_both(levelled), *registration.warnings),
    )


def _of_both(levelled: Iterable[Levelled]) -> tuple[str, ...]:
    """The warnings about the preparation of both surfaces, each once."""
    return tuple(dict.fromkeys(warning for each in levelled for warning in each.warnings))


def _mismatch(correlation: float) -> tuple[str, ...]:
    if correlation >= MIN_CORRELATION:
        return ()
    return (
        f"the unworn points of both measurements have a correlation of {correlation:.2f}, below {MIN_CORRELATION}: "
        "rotation, magnification or noise hide the wear; align the specimen and measure again",
    )


def _open(surface: Surface) -> Surface:
    return surface.with_heights(surface.heights, periodic=False)


def _periods(first: Surface, second: Surface) -> tuple[Surface, Surface] | None:
    """Both surfaces on the smaller number of points, if they are periods of one size without invalid points."""
    if not (first.periodic and second.periodic) or first.invalid.any() or second.invalid.any():
        return None
    if max(abs(a / b - 1) for a, b in zip(first.size, second.size, strict=True)) > 1e-6:
        return None
    (nx, ny), (mx, my) = first.shape, second.shape
    points = (min(nx, mx), min(ny, my))
    one, two = (
        surface if surface.shape == points else resample(surface, points, "band-limited") for surface in (first, second)
    )
    return one, two


def _registered(first: Surface, second: Surface, shift: Shift) -> Registration:
    if shift == "registered":
        return register(first, second)
    x, y = (float(length) / step for length, step in zip(shift, first.spacing, strict=True))
    return Registration(shift=(x, y), uncertainty=None, peak=None, warnings=())


def _aligned(first: Surface, second: Surface, shift: tuple[float, float]) -> tuple[Surface, Surface]:
    """Both surfaces on the pixels of the first one, over the common part; of periodic ones that is the whole period."""
    common = (slice(0, first.shape[0]), slice(0, first.shape[1]))
    if not first.periodic:
        common = overlap(first.shape, second.shape, shift)
    shape = (common[0].stop - common[0].start, common[1].stop - common[1].start)
    heights, valid = Sampler(second)((common[0].start - shift[0], common[1].start - shift[1]), shape)
    one = first.with_heights(first.heights[common], invalid=first.invalid[common])
    if not (valid & one.valid).any():
        raise InputError("registration: the surfaces have no valid point in common; give another shift")
    return one, one.with_heights(np.where(valid, heights, 0.0), invalid=~valid, source=second.source)


def _places(
    registration: Registration, first: Surface, second: Surface, compared: Mask, valid: Mask, smaller: int
) -> dict[str, Quantity]:
    """The quantities of the registration, with the correlation over the compared points."""
    widths = registration.uncertainty or (None, None)
    shifts = {
        f"shift_{axis}": Quantity(value=shift * step, unit="m", uncertainty=None if width is None else width * step)
        for axis, shift, width, step in zip("xy", registration.shift, widths, first.spacing, strict=True)
    }
    correlation = float(np.corrcoef(first.heights[compared], second.heights[compared])[0, 1])
    return {
        **shifts,
        "correlation": Quantity(value=correlation, unit="1"),
        "common_fraction": Quantity(value=float(valid.sum() / smaller), unit="1"),
    }


def _record(
    registration: Registration, first: Surface, recipe: Recipe, steps: list[Mapping[str, Any]]
) -> dict[str, Any]:
    peak = None if registration.peak is None else asdict(registration.peak)
    return {
        "shift": {"pixels": list(registration.shift), "registered": peak is not None, "peak": peak},
        "grid": {"points": list(first.shape), "spacing": list(first.spacing)},
        "recipe": recipe_entries(recipe),
        "steps": [dict(each) for each in steps],
    }


def _surface(
    heights: Array, valid: Mask, first: Surface, record: Mapping[str, Any], given: tuple[Surface, Surface]
) -> Surface:
    source = {"combined_from": [dict(surface.source) for surface in given], "combination": dict(record)}
    return first.with_heights(heights, invalid=~valid, source=source)
