"""The answer of a march: the last period, or all of the time, its extremes and means, and the orbit."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array, Mask
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.bearing.march.course import Duty
from roughfilm.rom.bearing.march.series import Series
from roughfilm.rom.bearing.march.throughput import throughput

REPEATED = 0.01
"""Largest difference of the last two periods over the clearance, or over the first film, of a settled march."""

AT_REST = 1e-3
"""Motion in the last part of a march over the clearance, or over the film then, below which the wall is at rest."""

LAST_PART = 0.2
"""The last part of a march without a period, for which its answer holds, and that before it, with which it agrees."""

SAMPLES = 400
"""Number of times at which two periods are compared."""

EXTREMES = {
    "film_min": ("least film thickness", "film_min", min),
    "pressure_max": ("peak pressure", "pressure_max", max),
    "cavitated_fraction_max": ("largest cavitated fraction", "cavitated_fraction", max),
}
CONTACT_EXTREMES = {
    "contact_pressure_max": ("largest contact pressure", "contact_pressure_max", max),
    "contact_area_max": ("largest fraction of the area in contact", "contact_area", max),
}
"""Titles, columns and extremes of walls that may touch."""
FORCE = "film_force_max"
"""The name of the largest force of the film on a given path."""

HEATED_EXTREMES = {"temperature_max": ("highest temperature of the film", "temperature", max)}
"""The same of a film that has a temperature."""

MEANS = {
    "pivot_film": "mean film at the pivot",
    "slope_x": "mean slope along the sliding",
    "slope_y": "mean slope across the sliding",
    "contact_load": "mean load of asperities",
    "friction": "mean friction",
    "torque": "mean torque",
    "power_loss": "mean power loss",
    "inlet_flow": "mean flow in",
    "outlet_flow": "mean flow out",
    "side_flow_low": "mean flow through the low side",
    "side_flow_high": "mean flow through the high side",
    "temperature": "mean temperature of the film",
}
"""Titles of the means of columns."""


@dataclass(frozen=True, kw_only=True)
class Summary:
    """The answer of a march.

    Attributes
    ----------
    first, last : times, s, for which the quantities hold.
    state : how the march ends, in words.
    settled : whether the last two periods, or parts, agree; None where nothing repeats.
    quantities : extremes and means between these times.
    titles : their titles.
    between : by how much an extreme may lie beyond its values at the steps, by its name.
    """

    first: float
    last: float
    state: str
    settled: bool | None
    quantities: Mapping[str, Quantity]
    titles: Mapping[str, str]
    between: Mapping[str, float]


def summary_of(duty: Duty, series: Series) -> Summary:
    """The answer of a march."""
    first, last, state, settled = _window(duty, series)
    inside = series.time >= first - 1e-9 * (last - first)
    quantities, titles, between = {}, {}, {}
    extremes = EXTREMES | (CONTACT_EXTREMES if "contact_load" in series.units else {})
    extremes |= HEATED_EXTREMES if "temperature" in series.units else {}
    for name, (title, column, extreme) in extremes.items():
        quantities[name] = Quantity(value=float(extreme(series[column][inside])), unit=series.units[column])
        titles[name], between[name] = title, _between(series, series[column], quantities[name].value, inside)
    if duty.given_path:
        force = np.abs(_film_force(duty, series))
        unit = series.units["film_force_x" if duty.lobes else "film_force"]
        quantities[FORCE] = Quantity(value=float(force[inside].max()), unit=unit)
        titles[FORCE] = "largest force of the film"
        between[FORCE] = _between(series, force, quantities[FORCE].value, inside)
    means = {name: title for name, title in MEANS.items() if name in series.units}
    for name in series.units:
        place, _, kind = name.rpartition("_")
        if place.startswith(("gap", "supply")):
            means[name] = f"mean {kind} {'in' if kind == 'pressure' else 'of'} {place.replace('_', ' ')}"
    passed = throughput(series)
    for name, title in means.items():
        value = mean(series, name, first, last)
        if name in passed:
            begun, ended = np.interp([first, last], series.time, passed[name])
            value = float(ended - begun) / (last - first)
        quantities[f"{name}_mean"] = Quantity(value=value, unit=series.units[name])
        titles[f"{name}_mean"] = title
    if duty.lobes:
        x, y = series["eccentricity_x"][inside], series["eccentricity_y"][inside]
        for name, title, value in (
            ("orbit_width", "width of the orbit over the clearance", float(np.ptp(x))),
            ("orbit_height", "height of the orbit over the clearance", float(np.ptp(y))),
            ("eccentricity_max", "largest eccentricity", float(np.hypot(x, y).max())),
        ):
            quantities[name], titles[name] = Quantity(value=value, unit="1"), title
    return Summary(
        first=first, last=last, state=state, settled=settled, quantities=quantities, titles=titles, between=between
    )


def _film_force(duty: Duty, series: Series) -> Array:
    """The size of the force of the film on a shaft over the steps, or its force on a pad, N (N/m)."""
    if duty.lobes:
        return np.hypot(series["film_force_x"], series["film_force_y"])
    return series["film_force"]


def _between(series: Series, values: Array, extreme: float, inside: Mask) -> float:
    """By how much an extreme of values over the steps may lie beyond them, between the step where it is and the others.

    It is the change to the step on the side on which values change less, carried on to the other side: little where
    they are smooth, and what is missed of a jump, as where a cavity closes. 0 at the first and the last step.
    """
    time, at = series.time, int(np.flatnonzero((values == extreme) & inside)[0])
    if not 0 < at < time.size - 1:
        return 0.0
    before, after = time[at] - time[at - 1], time[at + 1] - time[at]
    rises = abs(values[at] - values[at - 1]) / before * after, abs(values[at + 1] - values[at]) / after * before
    return float(min(rises))


def mean(series: Series, name: str, first: float, last: float) -> float:
    """The mean of a column over a range of time, by the trapezoidal rule."""
    time, values = series.time, series[name]
    inside = (time > first) & (time < last)
    times = np.concatenate([[first], time[inside], [last]])
    numbers = np.interp(times, time, values)
    return float(np.trapezoid(numbers, times) / (last - first))


def apart(duty: Duty, one: Series, other: Series, first: float, last: float) -> float:
    """The largest distance of a place of one of two paths from the other, over the clearance or over the first film.

    It is that of the paths between two times as curves. When a wall is at a place does not count: orbits that differ in
    their phase alone have the same extremes. No film thickness along one path differs by more from one along the other.
    """
    times = np.linspace(first, last, SAMPLES)
    paths = [
        np.stack([np.interp(times, series.time, values) for values in _places(duty, series).T], axis=1)
        for series in (one, other)
    ]
    return max(float(_from_curve(paths[n], paths[1 - n]).max()) for n in (0, 1))


def _from_curve(places: Array, curve: Array) -> Array:
    """The distances of places from a curve of straight pieces, both of shape (n, coordinates)."""
    begin, along = curve[:-1], np.diff(curve, axis=0)
    away = places[:, None] - begin
    size = np.maximum((along**2).sum(axis=1), np.finfo(float).tiny)
    part = np.clip((away * along).sum(axis=2) / size, 0.0, 1.0)
    return np.asarray(np.sqrt(((away - part[..., None] * along) ** 2).sum(axis=2)).min(axis=1))


def _places(duty: Duty, series: Series) -> Array:
    """The coordinates of the wall over the steps, over the clearance or the first film, shape (steps, k)."""
    if duty.lobes:
        return np.stack([series["eccentricity_x"], series["eccentricity_y"]], axis=1)
    lengths = lengths_of(duty, series)
    return np.stack([series[name] * lengths[name] for name in lengths], axis=1) / path_unit(duty, series)


def path_unit(duty: Duty, series: Series) -> float:
    """The clearance, or the first film, m, to which paths are related."""
    clearance = getattr(duty.scene.geometry, "clearance", None)
    return float(clearance or series["film" if "film" in series.units else "pivot_film"][0])


def lengths_of(duty: Duty, series: Series) -> dict[str, float]:
    """The motion of the wall per change of its coordinates, m/rad of slopes, by the names of the coordinates."""
    if duty.pivoted is None:
        return {"film": 1.0}
    lengths = {"pivot_film": 1.0, "slope_x": duty.pivoted.length, "slope_y": duty.pivoted.width or 0.0}
    return {name: length for name, length in lengths.items() if name in series.units}


def _window(duty: Duty, series: Series) -> tuple[float, float, str, bool | None]:
    """The times for which the answer holds, how the march ends in words, and whether it is settled."""
    time, places = series.time, _places(duty, series)
    begin, end, period = float(time[0]), float(time[-1]), duty.period
    if period is not None and end - begin >= period * (1 - 1e-9):
        if end - begin < 2 * period * (1 - 1e-9):
            return end - period, end, "one period; nothing shows whether it repeats", None
        change = _difference(time, places, period)
        words = f"the last two periods differ by {100 * change:.2g} % of the {_scale(duty)}"
        last = 1 if change <= REPEATED else max(2, int(LAST_PART * (end - begin) / period))  # a slower whirl, too
        return end - last * period, end, words, change <= REPEATED
    if period is not None:
        return begin, end, "all of the time, less than one period", None
    if duty.curves or duty.approach:
        return begin, end, "all of the time", None
    part = LAST_PART * (end - begin)
    if duty.turn is not None and part < duty.turn * (1 - 1e-9):
        turns = (end - begin) / duty.turn
        count = f"{turns:.2g} turn{'' if f'{turns:.2g}' == '1' else 's'}"
        return begin, end, f"all of the time, {count}, too short to show where the motion ends", None
    sizes = [_size(places[(time >= end - (n + 1) * part) & (time <= end - n * part)]) for n in (0, 1)]
    first = end - part
    if sizes[0] < AT_REST * (1.0 if duty.lobes else float(places[-1, 0])):
        if duty.turn is None:
            return first, end, f"the last part moves by less than {100 * AT_REST:g} % of the film", None
        return first, end, "at rest in its equilibrium", True
    if duty.lobes and duty.turn is not None:
        return first, end, *_whirl(series, sizes, duty.turn)
    growing = sizes[0] > sizes[1]
    return first, end, f"a motion that {'grows' if growing else 'decays'}", False


def _whirl(series: Series, sizes: list[float], turn: float) -> tuple[str, bool]:
    """How the shaft whirls without anything that drives it, and whether its orbit repeats; a turn takes ``turn``, s."""
    x, y = series["eccentricity_x"], series["eccentricity_y"]
    inside = series.time >= series.time[-1] - LAST_PART * (series.time[-1] - series.time[0])
    along, up, time = x[inside] - x[inside].mean(), y[inside] - y[inside].mean(), series.time[inside]
    turned = float(np.ptp(np.unwrap(np.arctan2(up, along)))) / float(np.ptp(time))
    ratio = turned * turn / (2 * math.pi)
    words = f"at {ratio:.3g} of the rotational speed"
    if abs(sizes[0] - sizes[1]) <= REPEATED * sizes[0]:
        return f"a whirl of constant size, a limit cycle, {words}", True
    return f"a whirl that {'grows' if sizes[0] > sizes[1] else 'decays'}, {words}", False


def _scale(duty: Duty) -> str:
    return "clearance" if duty.lobes else "first film"


def _size(places: Array) -> float:
    """The largest extent of a path along a coordinate."""
    return float(np.ptp(places, axis=0).max()) if len(places) else 0.0


def _difference(time: Array, places: Array, period: float) -> float:
    """The largest change of the coordinates from the last but one period to the last."""
    now = np.linspace(time[-1] - period, time[-1], SAMPLES)
    changes = [np.abs(np.interp(now, time, one) - np.interp(now - period, time, one)).max() for one in places.T]
    return float(max(changes))
