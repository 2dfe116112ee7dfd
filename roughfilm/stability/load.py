"""The map of films under a load: the load of a known film is given, and the film is sought."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import product
from statistics import median
from typing import Any

from roughfilm.ladder import find
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.stability.form import (
    BAD,
    GOOD,
    Judgement,
    MapOutcome,
    Probe,
    Spot,
    StabilityMap,
    count,
    in_groups,
    in_numbers,
    in_turn,
    listed,
)

MANY_FILMS = 12
"""Number of film solves on all grids together above which a search is slow."""

LOAD_TOLERANCE = 1e-5
"""Allowed relative error of the load at the film that was found, solved anew."""

SAME_FILM = 1e-2
"""Relative difference below which two films are the same; where a pressure at a side carries all but 10⁻⁵ of the load,
the load does not determine the film more closely."""

THICKER = (1.01, 1.2, 2.0, 5.0, 20.0)
"""Films over the one that was found, none of which may carry more than the load."""

LINE_REFINEMENT = 8
"""Cells of an infinitely wide film over those along a side of a film with a width."""

RISE = 10e-6
"""Rise of the pads, m."""

FILMS = (0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0)
"""Film thicknesses over the rise of a pad."""

ECCENTRICITIES = (0.01, 0.1, 0.3, 0.6, 0.9, 0.99, 0.999, 0.9995)
"""Eccentricities of the journals."""

WIDTHS = (0.05, 0.25, 1.0, 4.0, math.inf)
"""Widths over the length of a pad or the diameter of a journal."""

DEPTHS = (1e-6, 3e-6, 10e-6, 30e-6, 100e-6)
"""Depths of pockets, m."""

FILMS_OVER_DEPTH = (0.03, 0.1, 0.2, 0.3, 0.5, 1.0, 2.0, 5.0)
"""Film thicknesses over the depth of the pockets."""

THETAS = (0.2, 0.4, 0.6, 0.8, 0.95)
"""Density ratios at the inlet of starved pads."""

FILMS_OVER_LARGEST = (0.01, 0.03, 0.1, 0.3, 0.6, 0.9)
"""Film thicknesses of starved pads over the largest one, θ rise/(1 - θ), at which the inlet fills the outlet."""

AMPLITUDES = (0.03, 0.1, 0.3, 0.6, 0.9, 0.99)
"""Amplitudes of sinusoidal ridges over the film thickness."""

SIDE_PRESSURES = ("0.01 MPa", "0.1 MPa", "1 MPa", "10 MPa")
"""Pressures at one side of a pad."""

OIL: Mapping[str, Any] = {"viscosity": "0.02 Pa*s", "cavitation_pressure": "-0.1 MPa"}
PAD: Mapping[str, Any] = {"shape": "linear", "length": "20 mm", "rise": f"{RISE!r} m"}
JOURNAL: Mapping[str, Any] = {"shape": "journal", "radius": "25 mm", "clearance": "25 um"}
WASHER: Mapping[str, Any] = {
    "shape": "washer",
    "inner_radius": "20 mm",
    "outer_radius": "30 mm",
    "pockets": 8,
}


@dataclass(frozen=True, kw_only=True)
class Found:
    """The film that a search found, and those beside it.

    Attributes
    ----------
    known : film thickness whose load was given, m.
    film : film thickness that was found, m.
    uncertainty : its uncertainty as the result states it, m.
    films : number of films that the search solved.
    again : load of the found film, solved anew, over the given load.
    thicker : largest load of the ``THICKER`` films over the given load.
    """

    known: float
    film: float
    uncertainty: float
    films: int
    again: float
    thicker: float


def bearing(geometry: Mapping[str, Any], tables: Mapping[str, Any]) -> Bearing:
    """A bearing that slides at 2 m/s."""
    entries = {"name": "a bearing", "kind": "bearing", "lubricant": OIL, "motion": {"speed": "2 m/s"}}
    scene = read_scene({**entries, **tables, "geometry": dict(geometry)})
    assert isinstance(scene, Bearing)
    return scene


def found(geometry: Mapping[str, Any], tables: Mapping[str, Any], model: str, cells: int) -> Found:
    """Solve for the load of a known film, then search the film of this load, and solve at the found film.

    Parameters
    ----------
    geometry, tables : the geometry with its film, and the other tables of the scene.
    model : name of the model.
    cells : number of cells along a side.
    """
    known = bearing(geometry, tables)
    request = Request(resolution=cells * (LINE_REFINEMENT if known.wide else 1))
    solver = find("bearing", model)

    def load(film: float) -> float:
        return solver.solve(known.at_film(film), request)["specific_load"].value

    pressure = load(known.geometry.thinnest)
    free = {key: entry for key, entry in geometry.items() if key not in ("film", "eccentricity")}
    result = solver.solve(bearing(free, {**tables, "load": {"pressure": f"{pressure!r} Pa"}}), request)
    film, widest = result["film_min"].value, known.geometry.widest
    thicker = [ratio * film for ratio in THICKER if ratio * film < widest] or [(film + widest) / 2]
    return Found(
        known=known.geometry.thinnest,
        film=film,
        uncertainty=result["film_min"].uncertainty or 0.0,
        films=round(result.numerics.details["films"]),
        again=load(film) / pressure,
        thicker=max(load(more) for more in thicker) / pressure,
    )


def judged(answer: Found) -> Judgement:
    """The judgement of a film by its load, solved anew, by the known film, and by thicker films."""
    error, ratio = abs(answer.again - 1), answer.film / answer.known
    faults = []
    if error > LOAD_TOLERANCE:
        faults.append(f"the film carries {answer.again:.6g} of the load")
    if answer.thicker > 1 + LOAD_TOLERANCE:
        faults.append(f"a thicker film carries {answer.thicker:.6g} of the load")
    reported = not faults and answer.uncertainty >= answer.known - answer.film
    if ratio < 1 - SAME_FILM:
        faults.append(f"the film is {ratio:.6g} of the known one" + ", within its uncertainty" * reported)
    other = f"the thicker of two films that carry the load, {ratio:.4g} of the known one" * (ratio > 1 + SAME_FILM)
    return Judgement(
        iterations=answer.films,
        right=not faults,
        error=error,
        reported=reported,
        numbers={"film": answer.film, "known_film": answer.known},
        message="; ".join(faults) or other,
    )


@dataclass(frozen=True, kw_only=True)
class Case:
    """A bearing whose film is sought, and its place on the map.

    Attributes
    ----------
    group, row, column : names of the place on the map.
    geometry : the geometry with its film.
    tables : the other tables of the scene.
    model : name of the model.
    """

    group: str
    row: str
    column: str
    geometry: Mapping[str, Any]
    tables: Mapping[str, Any]
    model: str = "reynolds_cavitating"


def cases() -> Iterator[Case]:
    """The bearings of the map, each with the film whose load is given."""
    for width, eccentricity in product(WIDTHS, ECCENTRICITIES):
        geometry = {**JOURNAL, **_width(width, 50e-3), "eccentricity": eccentricity}
        yield Case(
            group="journal", row=f"B/D = {width:g}", column=f"e = {eccentricity:g}", geometry=geometry, tables={}
        )
    for width, film in product(WIDTHS, FILMS):
        geometry = {**PAD, **_width(width, 20e-3), **_film(film * RISE)}
        yield Case(group="pad", row=f"B/L = {width:g}", column=f"h/rise = {film:g}", geometry=geometry, tables={})
    for depth, film in product(DEPTHS, FILMS_OVER_DEPTH):
        pockets = {"length": "4 mm", "width": "6 mm", "start": "1 mm", "depth": f"{depth!r} m"}
        geometry = {"shape": "parallel", "length": "20 mm", "width": "20 mm", "texture": pockets, **_film(film * depth)}
        place = {"row": f"d = {depth * 1e6:g} µm", "column": f"h/d = {film:g}"}
        yield Case(group="parallel pad with a pocket", **place, geometry=geometry, tables={})
        pocket = {"share": 0.5, "extent": "5 mm", "depth": f"{depth!r} m"}
        geometry = {**WASHER, "pocket": pocket, **_film(film * depth)}
        fed = {"boundary": {"sides": {"low": "0.1 MPa"}}}
        yield Case(group="cell of a washer", **place, geometry=geometry, tables=fed)
    for theta, film in product(THETAS, FILMS_OVER_LARGEST):
        geometry = {**PAD, "width": "20 mm", **_film(film * RISE * theta / (1 - theta))}
        starved = {"boundary": {"inlet": {"theta": theta}}, "lubricant": {"viscosity": "0.02 Pa*s"}}
        place = {"row": f"θ = {theta:g}", "column": f"h/h_full = {film:g}"}
        yield Case(group="starved pad", **place, geometry=geometry, tables=starved)
    for amplitude, film in product(AMPLITUDES, FILMS):
        geometry = {**PAD, "width": "20 mm", **_film(film * RISE)}
        ridges = {"kind": "sinusoid", "wavelength": "0.5 mm", "amplitude": f"{amplitude * film * RISE!r} m"}
        place = {"row": f"a/h = {amplitude:g}", "column": f"h/rise = {film:g}"}
        tables = {"roughness": ridges}
        yield Case(group="averaged ridges", **place, geometry=geometry, tables=tables, model="homogenized")
    for pressure, film in product(SIDE_PRESSURES, FILMS):
        geometry = {**PAD, "width": "20 mm", **_film(film * RISE)}
        fed = {"boundary": {"sides": {"low": pressure}}}
        place = {"row": pressure, "column": f"h/rise = {film:g}"}
        yield Case(group="pad with a pressure at one side", **place, geometry=geometry, tables=fed)


def _width(ratio: float, length: float) -> dict[str, str]:
    return {} if math.isinf(ratio) else {"width": f"{ratio * length!r} m"}


def _film(film: float) -> dict[str, str]:
    return {"film": f"{film!r} m"}


PLAIN: Mapping[str, Any] = {**PAD, "width": "20 mm"}
RIDGES: Mapping[str, Any] = {"kind": "sinusoid", "wavelength": "0.5 mm", "amplitude": "5 um"}

REFUSED: Mapping[str, tuple[Mapping[str, Any], Mapping[str, Any], str]] = {
    "parallel walls": ({"shape": "parallel", "length": "20 mm", "width": "20 mm"}, {}, "reynolds_cavitating"),
    "a pad that slides backwards": (PLAIN, {"motion": {"speed": "-2 m/s"}}, "reynolds_cavitating"),
    "a load above that of the thinnest film": (PLAIN, {"load": {"pressure": "1e15 Pa"}}, "reynolds_cavitating"),
    "a load at which ridges touch": (PLAIN, {"load": {"pressure": "1 GPa"}, "roughness": RIDGES}, "homogenized"),
    "a load below that of the pressure at a side": (
        PLAIN,
        {"load": {"pressure": "1 kPa"}, "boundary": {"sides": {"low": "1 MPa"}}},
        "reynolds_cavitating",
    ),
    "no sliding": (PLAIN, {"motion": {"speed": "0 m/s"}}, "reynolds_cavitating"),
}
"""Bearings whose load, 1 MPa unless given, no film carries: geometry, other tables and model."""


def probes(cells: int) -> Iterator[Probe]:
    """The probes of all bearings on ``cells`` along a side, and of those whose load must be refused."""
    for case in cases():
        ask = partial(found, case.geometry, case.tables, case.model, cells)
        yield Probe(group=case.group, row=case.row, column=case.column, ask=ask, judge=judged, many=MANY_FILMS)
    for name, (geometry, tables, model) in REFUSED.items():
        loaded = partial(_solved, geometry, {"load": {"pressure": "1 MPa"}, **tables}, model, cells)
        yield Probe(group="loads that no film carries", row=name, column=model, ask=loaded, judge=judged, refused=True)


def _solved(geometry: Mapping[str, Any], tables: Mapping[str, Any], model: str, cells: int) -> object:
    return find("bearing", model).solve(bearing(geometry, tables), Request(resolution=cells))


def summary(spots: Sequence[Spot]) -> list[str]:
    """Sentences about the map: each group, the number of films, and where several films carry a load."""
    lines = []
    for name, own in in_groups(spots).items():
        if films := [spot.iterations for spot in own if spot.iterations]:
            lines.append(f"{name}: {in_numbers(own)}; {median(films):g} films at the median, at most {max(films)}.")
    thicker = [spot for spot in spots if spot.outcome in GOOD and spot.message]
    if thicker:
        lines.append(
            f"At {len(thicker)} places a thicker film than the known one carries the load too, and is found: "
            f"{', '.join(sorted({spot.group for spot in thicker}))}."
        )
    lines.append(f"{count(spots, MapOutcome.REFUSED)} loads that no film carries are refused.")
    return [*lines, *listed(spots, *BAD)]


LOAD = StabilityMap(
    name="load",
    title="Films under a load",
    axes="Journals, pads, pockets, cells of a washer, starved inlets, averaged ridges and fed sides (rows) at known "
    "film thicknesses (columns): a model gives the load of the known film, and searches the film of this load "
    "without it, on {resolution} cells along a side. Then loads that no film carries.",
    judge="The load of the film that was found, solved anew as a given film, which may differ by "
    f"{LOAD_TOLERANCE:g} and is the error; no thicker film, up to {max(THICKER):g} times, may carry more, so that the "
    "film is stable, and the film may not be thinner than the known one; it is inaccurate if its uncertainty covers "
    "that. Where a thicker film carries the same load, it must be found. Iterations are film solves on all "
    f"grids; more than {MANY_FILMS} are slow.",
    resolution=32,
    resolution_meaning="cells along a side of the film",
    least=32,
    most=128,
    allowed="the films take 32 to 128 cells along a side",
    solve=in_turn(probes),
    summary=summary,
)
