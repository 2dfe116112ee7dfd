"""The figures of the answers of a sweep: curves and maps over what varies, pressure profiles, errors and inertia."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.figures.base import new_figure, svg
from roughfilm.figures.view import View
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.studies.answers import Answer, Optimum, Sense, slice_of
from roughfilm.rom.studies.parameters import Parameter
from roughfilm.rom.studies.sufficient import InertiaChange, Suitability
from roughfilm.words.scales import Scale, scale_for

MAX_PANELS = 6
"""Largest number of combinations of the other parameters that have a panel each."""

MANY = 400
"""Number of cases above which marks are drawn as pixels."""

MIN_PERCENT = 1e-3

LOG_DECADES = 1.5
"""Decades above which positive values are drawn on a logarithmic axis."""


def planes_of(parameters: Sequence[Parameter]) -> tuple[Parameter, ...]:
    """The parameters of the axes: two numeric ones with three or more values, else one, else none."""
    numeric = [one for one in parameters if one.numeric]
    wide = [one for one in numeric if len(one.distinct) > 2]
    if len(wide) > 1:
        return tuple(wide[:2])
    return tuple(sorted(numeric, key=lambda one: -len(one.distinct))[:1])


def panels_of(
    parameters: Sequence[Parameter], axes: Sequence[Parameter], best: int
) -> tuple[list[tuple[str, NDArray[np.bool_]]], tuple[Parameter, ...]]:
    """The panels of a figure, as names and masks of their cases, and the parameters that are fixed at the best case.

    The other parameters have a panel for each combination of their values if there are at most ``MAX_PANELS``.
    """
    rest = [one for one in parameters if one.name not in {axis.name for axis in axes}]
    if not rest:
        return [("", np.ones(parameters[0].values.size if parameters else 1, dtype=bool))], ()
    codes = np.array([one.codes() for one in rest]).T
    combinations = list(dict.fromkeys(map(tuple, codes.tolist())))
    fixed = len(combinations) > MAX_PANELS
    chosen = [tuple(codes[best].tolist())] if fixed else combinations
    panels = []
    for combination in chosen:
        mask = (codes == combination).all(axis=1)
        case = int(np.flatnonzero(mask)[0])
        panels.append((", ".join(f"{one.name} = {one.text(case)}" for one in rest), mask))
    return panels, tuple(rest) if fixed else ()


def over_parameters(
    parameters: Sequence[Parameter],
    answers: Sequence[Answer],
    title: str,
    scale: Scale,
    view: View,
    found: Optimum | None = None,
) -> str:
    """A quantity over what varies: curves over one parameter, maps over two, dots over texts.

    Parameters
    ----------
    parameters : the parameters of the sweep.
    answers : the quantity by every model, the best model first.
    title : name of the quantity.
    scale : unit of the quantity.
    view : view of the kind of scene.
    found : the optimum between the cases along the only parameter.
    """
    axes = planes_of(parameters)
    if len(axes) == 2:
        return _maps(parameters, axes, answers[0], title, scale)
    panels, _ = panels_of(parameters, axes, answers[0].best)
    columns = min(len(panels), 3)
    rows = -(-len(panels) // columns)
    size = (8.5 if columns == 1 else 10, 0.4 + (4.4 if columns == 1 else 3.1) * rows)
    if not axes:
        panels, columns, rows, size = [("", np.ones(answers[0].values.size, dtype=bool))], 1, 1, (8.5, 4.4)
    figure, grid = new_figure(size, rows, columns, squeeze=False, sharey=True)
    for place, drawn in enumerate(grid.flat):
        if place >= len(panels):
            drawn.set_axis_off()
            continue
        name, mask = panels[place]
        drawn.set_title(name, fontsize=9)
        for answer in reversed(answers):
            _line(drawn, parameters, axes, answer, np.flatnonzero(mask), scale, view, answer is answers[0])
        _mark_best(drawn, parameters, axes, answers[0], mask, scale)
        if found is not None and axes and len(panels) == 1:
            drawn.axvline(found.place, color="black", linewidth=0.8, linestyle=":", label="optimum by the parabola")
        _scales(drawn, parameters, axes, np.concatenate([one.values for one in answers]))
        drawn.set_ylabel(scale.label(title) if place % columns == 0 else "")
    _limits(grid.flat[0], answers, scale)  # of all panels, which share the axis
    return _with_legend(figure, grid.flat[0], last_first=True)


def slices(
    parameters: Sequence[Parameter], answers: Sequence[Answer], title: str, scale: Scale, view: View
) -> str | None:
    """A quantity over each parameter alone, with the others as in the best case; None without such cases."""
    best = answers[0].best
    drawn = [one for one in parameters if np.isfinite(answers[0].values[slice_of(parameters, one, best)]).sum() > 1]
    if not drawn:
        return None
    columns = min(3, len(drawn))
    rows = -(-len(drawn) // columns)
    figure, grid = new_figure((10, 0.4 + 3.0 * rows), rows, columns, squeeze=False, sharey=True)
    for place, axes in enumerate(grid.flat):
        if place >= len(drawn):
            axes.set_axis_off()
            continue
        along = drawn[place]
        cases = slice_of(parameters, along, best)
        for answer in reversed(answers):
            _line(axes, [along], (along,), answer, cases, scale, view, answer is answers[0])
        mask = np.zeros(answers[0].values.size, dtype=bool)
        mask[cases] = True
        _mark_best(axes, [along], (along,), answers[0], mask, scale)
        _scales(axes, [along], (along,), np.concatenate([one.values[cases] for one in answers]))
        axes.set_ylabel(scale.label(title) if place % columns == 0 else "")
    return _with_legend(figure, grid.flat[0], last_first=True)


def several(parameters: Sequence[Parameter], shown: Sequence[tuple[Answer, str, Scale]], view: View, best: int) -> str:
    """Several quantities by the best model over the first parameter, a small panel each."""
    axes = planes_of(parameters)[:1] or tuple(parameters[:1])
    cases = slice_of(parameters, axes[0], best) if axes else np.arange(shown[0][0].values.size)
    columns = min(3, len(shown))
    rows = -(-len(shown) // columns)
    figure, grid = new_figure((10, 0.2 + 2.6 * rows), rows, columns, squeeze=False)
    for place, drawn in enumerate(grid.flat):
        if place >= len(shown):
            drawn.set_axis_off()
            continue
        answer, title, scale = shown[place]
        _line(drawn, axes, axes, answer, cases, scale, view, True)
        _scales(drawn, axes, axes, answer.values[cases])
        drawn.set_ylabel(scale.label(title), fontsize=8)
    return svg(figure)


def profiles(lines: Mapping[str, tuple[Array, Array]], label: str, lowest: float | None = None) -> str:
    """The pressure along the film of chosen cases: by name, positions in the unit of ``label`` and pressures in Pa."""
    largest = max(float(np.abs(pressure).max()) for _, pressure in lines.values())
    scale = scale_for("Pa", largest)
    figure, axes = new_figure((9, 3.8))
    for (name, (x, pressure)), style in zip(lines.items(), ("-", "--", ":"), strict=False):
        axes.plot(x, pressure / scale.factor, style, label=name, linewidth=2)
    if lowest is not None:
        axes.axhline(lowest / scale.factor, color="black", linewidth=0.8, linestyle=(0, (1, 2)))
    axes.set(xlabel=label, ylabel=scale.label("pressure above ambient"))
    figure.legend(loc="outside upper center", fontsize=8)
    return svg(figure)


def profile_of(result: Result) -> tuple[Array, Array, str] | None:
    """The positions, the pressures along the film and the label of the positions; None without such fields.

    Over a film with a width it is the middle line along the sliding direction.
    """
    place = result.fields.get("position", result.fields.get("x"))
    pressure = result.fields.get("pressure")
    if place is None or pressure is None or pressure.unit != "Pa":
        return None
    x, p = place.values, pressure.values
    if p.ndim == 2:
        middle = p.shape[1] // 2
        x, p = (x[:, middle] if x.ndim == 2 else x), p[:, middle]
    if p.ndim != 1 or x.shape != p.shape or x.size < 2:
        return None
    if place.unit == "rad":
        return np.degrees(x), p, "angle, degrees"
    factor, unit = (1e3, "mm") if place.unit == "m" else (1.0, place.unit)
    return x * factor, p, f"position along the sliding direction, {unit}"


def errors_along(
    parameters: Sequence[Parameter],
    errors: Mapping[str, Sequence[Suitability]],
    bars: Mapping[str, Array],
    tolerance: float,
    view: View,
) -> str:
    """The errors of every model over what varies, a panel for each quantity.

    Parameters
    ----------
    parameters : the parameters of the sweep.
    errors : by name of the quantity in a sentence, the errors of every model but the reference.
    bars : by the same names, uncertainty of the reference over the scale of the quantity, shape (cases,); NaN where
        unknown.
    tolerance : error within which a setting is sufficient, which is drawn as a line.
    view : view of the kind of scene.
    """
    axes, single = planes_of(parameters)[:1], len(parameters) == 1
    x, label = _positions(parameters, axes)
    order = np.argsort(x, kind="stable")
    figure, panels = new_figure((10, 3.8), 1, len(errors), squeeze=False)
    for drawn, (title, found) in zip(panels[0], errors.items(), strict=True):
        for one in found:
            style = view.style_of(one.setting)
            known = order[np.isfinite(one.error[order])]
            drawn.plot(
                x[known],
                np.maximum(100 * one.error[known], MIN_PERCENT),
                color=style.colour,
                marker=style.marker,
                ms=4,
                linestyle=style.line if single and axes else "none",
                label=one.setting,
                alpha=0.9 if single else 0.6,
                rasterized=known.size > MANY,
            )
        bar = np.maximum(100 * bars[title], MIN_PERCENT)
        known = order[np.isfinite(bar[order])]
        if known.size and single and axes:
            label_of_band = "below the uncertainty of the reference"
            drawn.fill_between(x[known], MIN_PERCENT, bar[known], color="black", alpha=0.08, label=label_of_band)
        elif known.size:
            label_of_band = "below the uncertainty of the reference (median)"
            drawn.axhspan(MIN_PERCENT, float(np.median(bar[known])), color="black", alpha=0.06, label=label_of_band)
        drawn.axhline(100 * tolerance, color="black", linewidth=0.8, linestyle=":")
        drawn.set(yscale="log", ylabel=f"error in {title}, %", xlabel=label)
        drawn.set_ylim(bottom=MIN_PERCENT)
        if axes and axes[0].logarithmic:
            drawn.set_xscale("log")
        _texts(drawn, parameters)
    return _with_legend(figure, panels[0][0])


def cheapest_models(
    parameters: Sequence[Parameter], cheapest: Sequence[str | None], tolerance: float, view: View
) -> str:
    """The cheapest sufficient model of every case over what varies: rows of marks, or marks in the plane of two.

    Parameters
    ----------
    parameters : the parameters of the sweep.
    cheapest : the cheapest sufficient setting in every case; None where none is known.
    tolerance : error within which a setting is sufficient.
    view : view of the kind of scene.
    """
    plane = planes_of(parameters)
    names = list(dict.fromkeys(name for name in cheapest if name is not None))
    flat = len(plane) == 2
    figure, axes = new_figure((7.5, 3.6) if flat else (9, 1.1 + 0.32 * len(names)))
    x, label = _positions(parameters, plane[:1])
    for row, name in enumerate(names):
        cases = np.array([case for case, chosen in enumerate(cheapest) if chosen == name], dtype=int)
        style = view.style_of(name)
        y = plane[1].values[cases] if flat else np.full(cases.size, float(row))
        look: dict[str, Any] = {"marker": style.marker, "color": style.colour or "black"}
        axes.plot(x[cases], y, linestyle="none", ms=7, label=name, alpha=0.8, rasterized=cases.size > MANY, **look)
    if flat:
        axes.set_ylabel(plane[1].label)
        if plane[1].logarithmic:
            axes.set_yscale("log")
        figure.legend(loc="outside right upper", fontsize=8)
    else:
        axes.set_yticks(range(len(names)), names, fontsize=8)
        axes.set_ylim(-0.6, len(names) - 0.4)
    if plane and plane[0].logarithmic:
        axes.set_xscale("log")
    axes.set_xlabel(label)
    axes.set_title(f"cheapest model within {100 * tolerance:g} % in all compared quantities", fontsize=9)
    _texts(axes, parameters)
    return svg(figure)


def inertia_along(parameters: Sequence[Parameter], changes: Mapping[str, Sequence[InertiaChange]], view: View) -> str:
    """The change by inertia of every compared quantity over what varies, in per cent; ``changes`` are by title."""
    axes = planes_of(parameters)[:1]
    x, label = _positions(parameters, axes)
    figure, panels = new_figure((10, 3.6), 1, len(changes), squeeze=False)
    for drawn, (title, found) in zip(panels[0], changes.items(), strict=True):
        for one in found:
            known = np.flatnonzero(np.isfinite(one.change))
            known = known[np.argsort(x[known], kind="stable")]
            style = view.style_of(one.setting)
            drawn.plot(
                x[known],
                100 * one.change[known],
                color=style.colour,
                marker=style.marker,
                ms=4,
                linestyle=style.line if len(parameters) == 1 else "none",
                label=f"{one.setting} minus {one.without}",
                rasterized=known.size > MANY,
            )
        drawn.axhline(0, color="black", linewidth=0.8)
        drawn.set(xlabel=label, ylabel=f"change of {title} by inertia, %")
        if axes and axes[0].logarithmic:
            drawn.set_xscale("log")
        _texts(drawn, parameters)
    return _with_legend(figure, panels[0][0])


def _maps(parameters: Sequence[Parameter], axes: Sequence[Parameter], answer: Answer, title: str, scale: Scale) -> str:
    panels, _ = panels_of(parameters, axes, answer.best)
    columns = min(len(panels), 3)
    rows = -(-len(panels) // columns)
    size = (7.5, 5.2) if len(panels) == 1 else (10.5, 0.3 + 3.4 * rows)
    figure, grid = new_figure(size, rows, columns, squeeze=False)
    values = answer.values / scale.factor
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    high = high if high > low else low + (abs(low) or 1.0)
    levels = MaxNLocator(12).tick_values(low, high)
    image: Any = None
    for place, drawn in enumerate(grid.flat):
        if place >= len(panels):
            drawn.set_axis_off()
            continue
        name, mask = panels[place]
        cases = np.flatnonzero(mask & np.isfinite(values))
        x, y = (one.values[cases] for one in axes)
        full = _full_grid(axes, np.flatnonzero(mask), values)
        if full is not None:
            image = drawn.contourf(*full, levels=levels, cmap="viridis")
            drawn.plot(x, y, ".", color="white", ms=7, mec="black", mew=0.5, rasterized=x.size > MANY)
        else:
            image = drawn.scatter(x, y, c=values[cases], vmin=levels[0], vmax=levels[-1], cmap="viridis", s=60)
        if mask[answer.best]:
            where = [one.values[answer.best] for one in axes]
            kind = "largest" if answer.sense is Sense.UNCLEAR else "best"
            drawn.plot(*where, "*", color="#d62728", mec="white", ms=16, clip_on=False, label=f"{kind} case")
        drawn.grid(visible=False)
        drawn.set_title(name, fontsize=9)
        drawn.set(xlabel=axes[0].label, ylabel=axes[1].label if place % columns == 0 else "")
        for one, set_scale in zip(axes, (drawn.set_xscale, drawn.set_yscale), strict=True):
            if one.logarithmic:
                set_scale("log")
    figure.colorbar(image, ax=grid, label=scale.label(title), shrink=0.9)
    figure.legend(loc="outside upper center", fontsize=8)
    return svg(figure)


def _full_grid(axes: Sequence[Parameter], cases: NDArray[np.int64], values: Array) -> tuple[Array, Array, Array] | None:
    """The values of the axes and the quantity on their grid; None if a case of the grid is missing."""
    places = [np.unique(one.values[cases]) for one in axes]
    grid = np.full((places[1].size, places[0].size), np.nan)
    columns, rows = (np.searchsorted(place, one.values[cases]) for place, one in zip(places, axes, strict=True))
    grid[rows, columns] = values[cases]
    return None if np.isnan(grid).any() or min(grid.shape) < 2 else (places[0], places[1], grid)


def _line(
    axes: Axes,
    parameters: Sequence[Parameter],
    along: Sequence[Parameter],
    answer: Answer,
    cases: NDArray[np.int64],
    scale: Scale,
    view: View,
    best: bool,
) -> None:
    """Draw a quantity of some cases over a parameter: a curve with a band over numbers, dots over texts."""
    x, _ = _positions(parameters, along)
    known = cases[np.isfinite(answer.values[cases]) & np.isfinite(x[cases])]
    known = known[np.argsort(x[known], kind="stable")]
    style = view.style_of(answer.setting)
    y, bars = scale.values(answer.values[known]), answer.uncertainty[known] / scale.factor
    numeric = bool(along) and along[0].numeric
    lines = numeric and np.unique(x[known]).size == known.size
    axes.plot(
        x[known],
        y,
        linestyle=style.line if lines else "none",
        marker=style.marker,
        color=style.colour,
        linewidth=2.6 if best else 1.2,
        markersize=6 if best else 4,
        alpha=1.0 if best else 0.75,
        label=f"{answer.setting} (best model)" if best else answer.setting,
        rasterized=known.size > MANY,
    )
    if best and np.isfinite(bars).any():
        if lines:
            axes.fill_between(x[known], y - bars, y + bars, color=style.colour, alpha=0.18, linewidth=0)
        else:
            axes.errorbar(x[known], y, np.nan_to_num(bars), fmt="none", color=style.colour, capsize=3, alpha=0.7)


def _mark_best(
    axes: Axes,
    parameters: Sequence[Parameter],
    along: Sequence[Parameter],
    answer: Answer,
    mask: NDArray[np.bool_],
    scale: Scale,
) -> None:
    if len(answer.order) < 2 or not mask[answer.best]:
        return
    x, _ = _positions(parameters, along)
    name = "largest" if answer.sense is Sense.UNCLEAR else "best"
    y = answer.values[answer.best] / scale.factor
    axes.plot(x[answer.best], y, "*", color="#d62728", mec="white", ms=15, zorder=5, label=f"{name} case")


def _positions(parameters: Sequence[Parameter], along: Sequence[Parameter]) -> tuple[Array, str]:
    """The places of the cases on the axis, and its label: values, the texts of one parameter, or numbers of cases."""
    if along and along[0].numeric:
        return along[0].values, along[0].label
    if len(parameters) == 1:
        return parameters[0].codes().astype(float), parameters[0].label
    size = parameters[0].values.size if parameters else 1
    return np.arange(1.0, size + 1), "number of the case"


def _texts(axes: Axes, parameters: Sequence[Parameter]) -> None:
    """Write the texts of a parameter on the axis."""
    if len(parameters) == 1 and not parameters[0].numeric:
        texts = parameters[0].distinct
        axes.set_xticks(range(len(texts)), texts, rotation=20 if max(map(len, texts)) > 12 else 0)
        axes.set_xlim(-0.5, len(texts) - 0.5)


def _scales(axes: Axes, parameters: Sequence[Parameter], along: Sequence[Parameter], values: Array) -> None:
    _, label = _positions(parameters, along)
    axes.set_xlabel(label)
    if along and along[0].logarithmic:
        axes.set_xscale("log")
    known = values[np.isfinite(values)]
    if known.size and known.min() > 0 and np.log10(known.max() / known.min()) > LOG_DECADES:
        axes.set_yscale("log")
    _texts(axes, parameters)


def _with_legend(figure: Figure, axes: Axes, *, last_first: bool = False) -> str:
    """The figure as SVG text, with the legend of one of its panels above it."""
    handles, labels = axes.get_legend_handles_labels()
    lines = dict(zip(labels, handles, strict=True))
    names = [*reversed(lines)] if last_first else [*lines]
    figure.legend([lines[name] for name in names], names, loc="outside upper center", ncols=4, fontsize=8)
    return svg(figure)


def _limits(axes: Axes, answers: Sequence[Answer], scale: Scale) -> None:
    """Keep a wide band from hiding the values."""
    values = np.concatenate([one.values for one in answers]) / scale.factor
    known = values[np.isfinite(values)]
    if axes.get_yscale() == "log" or not known.size or known.max() == known.min():
        return
    margin = 0.6 * float(np.ptp(known))
    low, high = axes.get_ylim()
    axes.set_ylim(max(low, known.min() - margin), min(high, known.max() + margin))
