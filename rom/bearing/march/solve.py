"""A march of a bearing with its answer, the uncertainty of the answer, and a file from which it goes on."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Protocol

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.contact.foundation.ranges import in_range, whole_in_range
from roughfilm.contact.foundation.units import ZERO_CELSIUS, Quantity
from roughfilm.rom.bearing.geometry.open_bore import OpenBore
from roughfilm.rom.bearing.march.course import Duty, film_at, refuse_unsupported
from roughfilm.rom.bearing.march.journals import with_coordinates
from roughfilm.rom.bearing.march.numbers import Observer
from roughfilm.rom.bearing.march.rough_walls import walls_of
from roughfilm.rom.bearing.march.series import Numerics, Series, run
from roughfilm.rom.bearing.march.store import finish, keeper, kept
from roughfilm.rom.bearing.march.summary import FORCE, Summary, apart, lengths_of, path_unit, summary_of
from roughfilm.rom.bearing.outside import ReynoldsNumbers, gas_as_liquid, turbulence
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.thermal.exchange import ESTIMATED
from roughfilm.rom.bearing.thermal.leading import leading_in_series
from roughfilm.rom.cavitation.solve import FIRST_COARSENING
from roughfilm.rom.ladder.model import Progress, silent
from roughfilm.rom.ladder.provenance import code
from roughfilm.rom.ladder.scene import scene_entries
from roughfilm.rom.lubricants.compressibility import Incompressible

CELLS = (64, 32)
"""Cells along and across."""

ERROR = 1e-3
"""Largest error of a step."""

MIN_CELLS, MAX_CELLS = 8, 512
"""Smallest and largest number of cells along a side."""

MAX_STEPS = 1_000_000
"""Largest number of steps of one length."""

MAX_FIELDS = 1000
"""Largest number of times at which fields are kept."""

COARSER_ERROR, FINER_ERROR = 4.0, 0.25
"""Error of a step of the march that shows the error by the time steps, over that of the march; the second one is taken
if the first march stops."""

COARSENINGS = {"coarse": FIRST_COARSENING, "finer": 0.8}
"""Cells of the coarse grid over those of the march; the second one is taken if a march on the first one stops."""

GRID_SAFETY = 4.0
"""Uncertainty by the grid over the difference to the first coarse grid."""

TIME_SAFETY = 1.5
"""Uncertainty by the time steps over the difference to longer steps, on the coarse grid.

Steps twice as long differ by three times the error of second order, and by the error itself of first order.
"""

ORBIT = ("film_min", "eccentricity_max", "orbit_width", "orbit_height")
ORBIT_SAFETY = 0.4
"""Uncertainty by the time steps of a path and of these extremes over the difference to longer steps.

A path is of second order also where forces jump, so that steps twice as long differ by three times its error.
"""

PATH_SAFETY = 1.0
"""Least uncertainty of the extremes of a path over its differences to those of the other marches."""

FLOW_SAFETY = 0.2
"""Least uncertainty of a mean flow over the largest one of the flows, which balance each other."""

NO_TRANSFER = "no march ends with half of the heat transfer that is estimated, or with twice as much"

FRICTIONS = frozenset({"friction_mean", "torque_mean", "power_loss_mean"})
FRICTION_SAFETY = 0.3
"""Least relative uncertainty of these means over the difference of the path."""

PARTS = {"fine": 0.6, "coarse": 0.25, "steps": 0.15}
"""The marches, that of the scene, on a coarse grid, and with other steps there, with the part of the work of each."""

PARTS_OF_HEAT = {"fine": 0.46, "coarse": 0.2, "steps": 0.12, "transfer": 0.22}
"""The same where a heat transfer may be estimated, with marches with both ends of its range."""


@dataclass(frozen=True, kw_only=True)
class March:
    """A bearing in time.

    Attributes
    ----------
    scene : the bearing.
    placed : the bearing in the coordinates of its wall; a journal is a full bore with its inlet at ``inlet_angle``.
    numerics : the grid and the time steps.
    series : the numbers of every step, ``march["film_min"]``, and fields at some times.
    first, last : times, s, between which the quantities hold: the last period, or all of the time.
    state : how the march ends, such as "at rest in its equilibrium".
    settled : whether the last two periods agree; None where nothing repeats.
    quantities : extremes and means, with uncertainties.
    titles : the titles of the quantities.
    warnings : what to know about the numbers.
    outside : the ways in which the film is at some time outside the range of the model; errors are then unknown.
    """

    scene: Bearing
    placed: Bearing
    numerics: Numerics
    series: Series
    first: float
    last: float
    state: str
    settled: bool | None
    quantities: Mapping[str, Quantity]
    titles: Mapping[str, str]
    warnings: tuple[str, ...]
    outside: tuple[str, ...] = ()

    @property
    def time(self) -> Array:
        """The times of the steps, s."""
        return self.series.time

    def __getitem__(self, name: str) -> Array:
        """The numbers of a name over the steps, in SI units; ``march.series.units`` has the names."""
        if name not in self.series.units:
            raise InputError(f"march: got {name!r:.60}; the numbers are {', '.join(self.series.units)}")
        return self.series[name]


def numerics_of(
    duty: Duty,
    *,
    end: float | None,
    error: float,
    steps: int | None,
    cells: tuple[int, int],
    fields: int,
) -> Numerics:
    """The grid and the time steps of a march; InputError if an end, an error or a count is out of range."""
    begin = duty.begin
    last = duty.default_end() if end is None else in_range("end", end, "s")
    if last <= begin:
        raise InputError(f"end: got {last!r} s; it must be after the first time, {begin!r} s")
    table = duty.scene.motion.over_time
    if table is not None and table.period is None and last > (longest := float(table.table.time[-1])) * (1 + 1e-9):
        raise InputError(f"end: got {last!r} s; the table ends at {longest!r} s, give less, or motion.over_time.period")
    if duty.approach > 0 and (contact := duty.scene.geometry.thinnest / duty.approach) <= last:
        raise InputError(f"end: got {last!r} s; the walls touch at {contact!r} s, give less")
    if steps is not None:
        whole_in_range("steps", steps, 1, MAX_STEPS)
    if in_range("error", error, "1") > 1:
        raise InputError(f"error: got {error!r}; it must be at most 1")
    whole_in_range("fields", fields, 0, MAX_FIELDS)
    return Numerics(
        cells=cells,
        end=last,
        error=error if steps is None else None,
        step=duty.largest_step(last) if steps is None else (last - begin) / steps,
        field_times=tuple(np.linspace(begin, last, fields).tolist()) if fields else (),
    )


def march_bearing(
    scene: Bearing,
    *,
    end: float | None = None,
    error: float = ERROR,
    steps: int | None = None,
    cells: tuple[int, int] = CELLS,
    fields: int = 0,
    uncertain: bool = True,
    path: Path | None = None,
    progress: Progress = silent,
) -> March:
    """March a bearing in time, with the uncertainty of its answer.

    Two marches on a grid with 0.62 times the cells, of which one has longer steps, show the errors by grid and steps.
    Where one of them stops, shorter steps or a grid with 0.8 times the cells take its place. If a heat transfer is
    estimated at some step, two more like the second one have half of it and twice as much.

    Parameters
    ----------
    end : last time, s; by default that of the table, five of its periods, or 20 turns.
    error : largest error of a step.
    steps : number of equal steps, in place of steps by their error.
    cells : cells along and across.
    fields : number of times, evenly spaced, at which fields are kept.
    uncertain : whether the uncertainty is estimated.
    path : HDF5 file from which a stopped march goes on.

    Raises
    ------
    InputError
        For a scene without a march, or an option out of range.
    ConvergenceError
        If a film becomes too thin, or a step does not converge.
    """
    if not isinstance(cells, tuple | list | np.ndarray) or len(cells) != 2:
        raise InputError(f"cells: got {repr(cells)[:60]}; give two whole numbers, along and across")
    for name, count in zip(("cells along", "cells across"), cells, strict=True):
        whole_in_range(name, count, MIN_CELLS, MAX_CELLS)
    duty = Duty(scene=with_coordinates(scene, cells))
    refuse_unsupported(duty)
    numerics = numerics_of(duty, end=end, error=error, steps=steps, cells=cells, fields=fields)
    entries = scene_entries(scene)
    entries.pop("name", None)
    settings = {
        "scene": entries,
        "cells": list(cells),
        "end": numerics.end,
        "error": numerics.error,
        "step": numerics.step,
        "fields": fields,
        "code": code(),
    }
    inputs = Inputs(heights=np.zeros((0, 0)), spacing=(0.0, 0.0), settings=settings)
    insulated = scene.lubricant.lacking or (scene.heat is not None and scene.heat.heat_transfer is not None)
    shares = (PARTS if insulated else PARTS_OF_HEAT) if uncertain else {"fine": 1.0}
    furthest = 0.0

    def report(fraction: float, words: str) -> None:
        nonlocal furthest
        furthest = max(furthest, fraction)
        progress(furthest, words)

    def marched(name: str, given: Numerics, part: str, transfer: float = 1.0) -> Series:
        known = () if path is None else kept(path, inputs, name)
        start, share = sum(list(shares.values())[: list(shares).index(part)]), shares[part]
        return run(
            duty,
            given,
            part=transfer,
            known=known,
            keep=(lambda _chunk: None) if path is None else keeper(path, inputs, name, len(known)),
            progress=lambda fraction, words: report(start + share * fraction, words),
        )

    series = marched("fine", numerics, "fine")
    summary = summary_of(duty, series)
    quantities, warnings = dict(summary.quantities), _warnings(summary) + scene.lubricant.left_out_heat
    if uncertain:
        try:
            others = _compared(numerics, marched, estimated=_estimates(series))
        except (InputError, ConvergenceError) as fault:
            warnings.append(f"no uncertainty: all marches on coarser grids stopped ({fault})")
        else:
            found = _uncertainties(duty, summary, series, others, cells[0])
            found = _with_walls(duty, summary, found, cells)
            known = {name: error for name, error in found.items() if math.isfinite(error)}
            quantities = {name: replace(one, uncertainty=known.get(name)) for name, one in quantities.items()}
            if unknown := found.keys() - known.keys():
                why = NO_TRANSFER if others.transfers is None else "the roughness has too few points"
                warnings.append(f"{', '.join(sorted(unknown))}: unknown uncertainty, as {why}")
    walls = walls_of(duty.scene)
    spots = walls.spots(float(series["film_min"].min()))
    warnings += () if spots is None else spots.warnings
    if "temperature" in series.units:
        warnings += scene.lubricant.hot(float(series["temperature"].max()) + ZERO_CELSIUS)
        held = (series.time >= summary.first) & (series.time <= summary.last)
        transfers = series["estimated_heat_transfer"][held].tolist()
        leading = "" if transfers[-1] else series.leading
        warnings += leading_in_series(transfers, "steps in that time", [("at the last time", leading)])
    infinite = Observer(duty=duty, film=film_at(duty, cells, walls)).infinite_flows
    if infinite:
        quantities |= {
            f"{name}_mean": replace(quantities[f"{name}_mean"], uncertainty=None) for name in sorted(infinite)
        }
        warnings.append(
            f"{', '.join(sorted(infinite))}: these flows are infinite if the film is full at a corner between two "
            "edges of different pressures; their numbers grow with the logarithm of the cells; give these edges one "
            "pressure, or [[supply]] with grooves that end before the sides"
        )
    bore, titles = duty.scene.geometry, dict(summary.titles)
    if isinstance(bore, OpenBore):
        angle = math.remainder(bore.first + math.pi, 2 * math.pi)
        quantities["inlet_angle"] = Quantity(value=math.degrees(angle), unit="deg")
        titles["inlet_angle"] = "angle of the inlet from the x axis"
    march = March(
        scene=scene,
        placed=duty.scene,
        numerics=numerics,
        series=series,
        first=summary.first,
        last=summary.last,
        state=summary.state,
        settled=summary.settled,
        quantities=quantities,
        titles=titles,
        warnings=tuple(warnings),
        outside=(*_outside(duty.scene, series), *(() if spots is None else spots.outside)),
    )
    if path is not None:
        finish(path, series, entries_of(quantities))
    return march


def _outside(scene: Bearing, series: Series) -> tuple[str, ...]:
    """The ways in which films of a march are outside the range of the model, with the steps at which they are."""
    columns = ("reynolds_number_of_sliding", "reynolds_number_of_pressure", "reynolds_number_of_clearance")
    numbers = np.array([series[name] if name in series.units else np.zeros(len(series.rows)) for name in columns])
    pressure, film = series["pressure_max"], float(series["film_min"].min())
    fixed = isinstance(scene.lubricant.compressibility, Incompressible)

    def sentences(reynolds: Array, highest: float) -> tuple[str, ...]:
        shear, driven, clearance = map(float, reynolds)
        found = turbulence(scene, ReynoldsNumbers(shear=shear, pressure=driven, clearance=clearance))
        return (*found, *(gas_as_liquid(scene, highest, film) if fixed else ()))

    degrees = series["temperature"] + ZERO_CELSIUS if "temperature" in series.units else np.zeros(0)
    heated = scene.lubricant.beyond(float(degrees.min()), float(degrees.max())) if degrees.size else []
    worst = sentences(numbers.max(axis=1), float(pressure.max()))
    if not worst:
        return tuple(heated)
    beyond = [one for one, *step in zip(series.time, numbers.T, pressure, strict=True) if sentences(*step)]
    steps = f"at {len(beyond)} of {len(series.rows)} steps, from {beyond[0]:.4g} s to {beyond[-1]:.4g} s"
    return (*(f"{sentence}, {steps}" for sentence in worst), *heated)


@dataclass(frozen=True, kw_only=True)
class _Compared:
    """Two marches to which a march is compared.

    Attributes
    ----------
    coarse : that on a coarse grid.
    steps : that with longer or shorter steps on the same grid.
    of_grid : error by the grid over the difference to the coarse grid, relative to that of the first coarse grid.
    of_steps : error by the steps over the difference to the other steps, relative to that of longer ones.
    transfers : marches as that with other steps with each end of the range of a heat transfer that is estimated; none
        where it is not, None if one of them stops.
    """

    coarse: Series
    steps: Series
    of_grid: float
    of_steps: float
    transfers: tuple[Series, ...] | None = ()


class _Marched(Protocol):
    """The march of a name, the part of the work that it is, and its heat transfer over the one that is estimated."""

    def __call__(self, name: str, given: Numerics, part: str, transfer: float = 1.0, /) -> Series:
        """Run the march."""
        ...


def _estimates(series: Series) -> bool:
    """Whether the heat transfer is estimated at a step."""
    return "estimated_heat_transfer" in series.units and bool(series["estimated_heat_transfer"].any())


def _compared(numerics: Numerics, marched: _Marched, *, estimated: bool) -> _Compared:
    """The marches on the first coarse grid on which they do not stop.

    Parameters
    ----------
    marched : runs a march.
    estimated : whether the heat transfer is estimated at a step.

    Raises
    ------
    InputError, ConvergenceError
        If the march on the finest of the coarse grids stops.
    """
    stopped: InputError | ConvergenceError | None = None
    for name, ratio in COARSENINGS.items():
        cells = (_coarser(numerics.cells[0], ratio), _coarser(numerics.cells[1], ratio))
        given = replace(numerics, cells=cells, field_times=())
        try:
            coarse = marched(name, given, "coarse")
        except (InputError, ConvergenceError) as fault:
            stopped = fault
            continue
        for steps, other_error in (("longer", COARSER_ERROR), ("shorter", FINER_ERROR)):
            try:
                following = marched(f"{name}, {steps} steps", _with_error(given, other_error), "steps")
            except ConvergenceError as fault:
                stopped = fault
                continue
            transfers: tuple[Series, ...] | None
            try:
                transfers = tuple(
                    marched(
                        f"{name}, {steps} steps, {end:g} of the heat transfer",
                        _with_error(given, other_error),
                        "transfer",
                        end,
                    )
                    for end in (ESTIMATED if estimated else ())
                )
            except (InputError, ConvergenceError):
                transfers = None
            return _Compared(
                coarse=coarse,
                steps=following,
                of_grid=(1 / FIRST_COARSENING - 1) / (1 / ratio - 1),
                of_steps=abs((COARSER_ERROR - 1) / (other_error - 1)),
                transfers=transfers,
            )
    assert stopped is not None
    raise stopped


def _uncertainties(duty: Duty, summary: Summary, fine: Series, others: _Compared, fine_cells: int) -> dict[str, float]:
    """The uncertainty of each quantity, from a coarser grid, and from that with other steps too.

    The changes of each quantity with both ends of the range of a heat transfer that is estimated add to it.

    The difference of two extremes may be small by chance; that of the paths on which they lie bounds it from below, and
    the edge of a cavity is known to one cell along the film. A path that is given has no error. What an extreme may
    miss between two steps is added. The means of the flows balance each other, so that each one has a part of the
    largest of their uncertainties at least.
    """
    coarse, steps = (summary_of(duty, one).quantities for one in (others.coarse, others.steps))
    found = {
        name: GRID_SAFETY * others.of_grid * abs(one.value - coarse[name].value)
        + (ORBIT_SAFETY if name in ORBIT else TIME_SAFETY)
        * others.of_steps
        * abs(coarse[name].value - steps[name].value)
        + summary.between.get(name, 0.0)
        for name, one in summary.quantities.items()
    }
    times = summary.first, summary.last
    path = 0.0
    if not duty.given_path or duty.pivoted is not None:
        path = others.of_grid * apart(duty, fine, others.coarse, *times)
        path += ORBIT_SAFETY * others.of_steps * apart(duty, others.coarse, others.steps, *times)
    unit = path_unit(duty, fine)
    least = dict.fromkeys(("eccentricity_max", "orbit_width", "orbit_height"), PATH_SAFETY * path)
    least |= {"film_min": PATH_SAFETY * path * unit, "cavitated_fraction_max": 1 / fine_cells}
    if duty.pivoted is not None:
        lengths = lengths_of(duty, fine)
        least |= {f"{name}_mean": PATH_SAFETY * path * unit / length for name, length in lengths.items()}
    film, pressure = (summary.quantities[name].value for name in ("film_min", "pressure_max"))
    least["pressure_max"] = abs(pressure) * least["film_min"] / film
    if FORCE in found:
        least[FORCE] = summary.quantities[FORCE].value * least["film_min"] / film
    for name in FRICTIONS & summary.quantities.keys():
        least[name] = FRICTION_SAFETY * path * abs(summary.quantities[name].value)
    flows = [name for name in found if "_flow_" in name]
    least |= dict.fromkeys(flows, FLOW_SAFETY * max((found[name] for name in flows), default=0.0))
    if others.transfers is None:
        return dict.fromkeys(found, math.inf)
    ends = [summary_of(duty, one).quantities for one in others.transfers]
    of_transfer = {
        name: max((abs(end[name].value - one.value) for end in ends), default=0.0) for name, one in steps.items()
    }
    return {name: max(one, least.get(name, 0.0)) + of_transfer[name] for name, one in found.items()}


def _with_walls(
    duty: Duty, summary: Summary, uncertainties: Mapping[str, float], cells: tuple[int, int]
) -> dict[str, float]:
    """The uncertainties with those of flow factors, of their lay, and of contact pressures, at the least film."""
    walls, quantities = walls_of(duty.scene), summary.quantities
    if walls.factors is None:
        return dict(uncertainties)
    film, even = quantities["film_min"].value, film_at(duty, cells, walls).solved.halved
    of_factors = walls.of_factors(film) + walls.of_lay(film, even=even)
    of_contact, moved = walls.of_contact(film)
    relative = dict.fromkeys(quantities, of_factors)
    relative |= {name: of_contact for name in quantities if name.startswith("contact")}
    if duty.scene.asperities is not None and quantities["friction_mean"].value:
        boundary = duty.scene.boundary_friction * quantities["contact_load_mean"].value
        share = min(abs(boundary / quantities["friction_mean"].value), 1.0)
        relative |= dict.fromkeys(FRICTIONS & quantities.keys(), of_factors + share * of_contact)
    more = {name: abs(quantities[name].value) * part if part else 0.0 for name, part in relative.items()}
    more["film_min"] += moved
    return {name: error + more[name] for name, error in uncertainties.items()}


def entries_of(quantities: Mapping[str, Quantity]) -> dict[str, dict[str, float | str]]:
    """The quantities as entries for JSON."""
    return {
        name: {
            "value": quantity.value,
            "unit": quantity.unit,
            **({} if quantity.uncertainty is None else {"uncertainty": quantity.uncertainty}),
        }
        for name, quantity in quantities.items()
    }


def _coarser(count: int, ratio: float) -> int:
    return max(MIN_CELLS // 2, 2 * round(ratio * count / 2))


def _with_error(numerics: Numerics, factor: float) -> Numerics:
    """The numerics with a multiple of the error of a step, and with a largest step that is √factor times as long.

    The error is related to the largest step, so that steps of second order are √factor times as long, whether the
    error or the largest step limits them.
    """
    error = None if numerics.error is None else min(factor * numerics.error, 1.0)
    return replace(numerics, step=math.sqrt(factor) * numerics.step, error=error)


def _warnings(summary: Summary) -> list[str]:
    """Why the answer may not hold later."""
    if summary.settled is None or summary.settled:
        return []
    return [f"the march is not settled: {summary.state}; take a later end"]
