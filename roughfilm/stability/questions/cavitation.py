"""Films that test the default cavitation solver, each with its own check."""

from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from itertools import product

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.closed_forms.sliding import barus_pressure, linear_slider, rayleigh_step
from roughfilm.rom.bearing.geometry.journal import Journal
from roughfilm.rom.bearing.geometry.ring import Sector
from roughfilm.rom.bearing.geometry.shapes import Parallel, Step
from roughfilm.rom.bearing.geometry.texture import Texture, pocketed
from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.network import State
from roughfilm.rom.cavitation.shape import Shape
from roughfilm.rom.cavitation.solve import solve
from roughfilm.rom.lubricants.compressibility import DowsonHigginson
from roughfilm.rom.lubricants.viscosity import Barus, Roelands
from roughfilm.stability.form import Probe
from roughfilm.stability.questions.films import (
    BALANCE_TOLERANCE,
    CELLS,
    FILM,
    LENGTH,
    PRESSURE_UNIT,
    ROUND_OFF,
    SEED,
    SPEED,
    VISCOSITY,
    Answer,
    against,
    against_exact,
    balance,
    bound,
    film,
    film_probe,
    linear,
    liquid,
    metres,
    mirrored,
    parabola,
    slider,
    steps_of,
)

PLANE = (32, 24)
"""Number of cells along and across the films of finite width."""

MAXIMUM_MISS_FACTOR = 10
"""Approximate relative error of the greatest nodal pressure, divided by (cell/length)²."""


def probes(plane: tuple[int, int] = PLANE) -> Iterator[Probe]:
    """All probes; films of finite width have ``plane`` cells along and across."""
    yield from _reversed()
    yield from _at_rest()
    yield from _starved()
    yield from _restarted()
    yield from _laws()
    yield from _steps()
    yield from _pockets()
    yield from _in_the_plane(plane)
    yield from _stiffening()


def _reversed() -> Iterator[Probe]:
    """Films that are mirrored together with the sliding; the answer must be the same."""
    texture = Texture(length=metres(6e-3), depth=metres(1e-5), start=metres(8e-3), pitch=metres(2e-2), columns=3)
    shapes = {"linear": linear(), "textured": pocketed(linear(), texture)}
    conditions = {"flooded": Ends(), "starved": Ends(theta=0.52), "pressurised": Ends(inlet=PRESSURE_UNIT)}
    for (name, shape), (column, ends) in product(shapes.items(), conditions.items()):
        yield film_probe("reversed sliding", name, column, partial(_mirror_error, shape, ends), ROUND_OFF)


def _mirror_error(shape: Shape, ends: Ends) -> Answer:
    forward = solve(film(shape, ends, compressibility=liquid(0.1)), (CELLS, 1))
    back = solve(film(mirrored(shape), ends, compressibility=liquid(0.1), speed=-SPEED), (CELLS, 1))
    pressure = np.abs(forward.state.pressure - back.state.pressure).max() / PRESSURE_UNIT
    fill = np.abs(forward.state.fill - back.state.fill).max()
    return steps_of(back), float(max(pressure, fill))


def _at_rest() -> Iterator[Probe]:
    """Films without sliding: θ (constant bulk modulus) or p (constant density) varies linearly with ∫ h⁻³ dx."""
    pressures = {"no pressure": 0.0, "inlet 0.01 MPa": 1e4, "inlet 10 MPa": 1e7}
    liquids = {"incompressible": None, "β = 0.05 GPa": 0.05}
    for (name, pressure), (column, modulus) in product(pressures.items(), liquids.items()):
        yield film_probe("at rest", name, column, partial(_rest_error, pressure, modulus), bound(CELLS))
    starved = film(linear(), Ends(theta=0.5), speed=0.0)
    yield film_probe("at rest", "no inflow", "θ = 0.5", partial(against, starved, CELLS, float), ROUND_OFF)


def _rest_error(pressure: float, modulus: float | None) -> Answer:
    given = {} if modulus is None else {"compressibility": liquid(modulus)}
    solution = solve(film(linear(), Ends(inlet=pressure), speed=0.0, **given), (CELLS, 1))
    # ∫ h⁻³ dx of h = FILM (2 - x/L) from 0 to x, over that to L
    fraction = ((2 - solution.grid.x / LENGTH) ** -2 - 0.25) / 0.75
    if modulus is None:
        truth = pressure * (1 - fraction)
    else:
        theta = 1 + np.expm1(pressure / (modulus * 1e9)) * (1 - fraction)
        truth = modulus * 1e9 * np.log(theta)
    error = np.abs(solution.state.pressure[:, 0] - truth).max() / (pressure or PRESSURE_UNIT)
    return steps_of(solution), float(error)


def _starved() -> Iterator[Probe]:
    """Parabolic sliders at θ near 1/2, from which on they have a film, and at much smaller θ."""
    for theta, modulus in product((1e-12, 1e-6, 1e-3, 0.3, 0.4999, 0.5, 0.5001, 0.501, 0.51), (0.05, 100.0)):
        ask = partial(against_exact, slider(theta, liquid(modulus)), 10 * CELLS)
        # without a film, errors are relative to the unit of load, a hundred times the load of the flooded slider; a
        # film that is a few cells long has an error of 1 to 10 %
        allowed = bound(10 * CELLS) / 100 if theta < 0.5001 else 0.1 if theta < 0.501 else 0.01
        yield film_probe("very starved", f"β = {modulus:g} GPa", f"θ = {theta:g}", ask, allowed)


def _restarted() -> Iterator[Probe]:
    """Sliders solved from initial states far from the solution, without coarser grids."""
    random = np.random.default_rng(SEED)
    for cells in (200, 10 * CELLS):
        shape = (cells + 1, 1)
        noise = random.random(shape)
        states: dict[str, tuple[Array, Array]] = {
            "full, no pressure": (np.zeros(shape), np.ones(shape)),
            "empty": (np.zeros(shape), np.zeros(shape)),
            "1 GPa everywhere": (np.full(shape, 1e9), np.ones(shape)),
            "random": (np.where(noise > 0.5, noise * PRESSURE_UNIT, 0.0), np.where(noise > 0.5, 1.0, noise)),
        }
        for modulus in (0.05, 1.0, 100.0):
            other = solve(slider(1.0 if modulus == 1 else 0.55, liquid(10.0)), (cells, 1)).state
            starts = {**states, "another slider": (other.pressure, other.fill)}
            for (name, (pressure, fill)), theta in product(starts.items(), (0.2, 0.55, 1.0)):
                start = State(pressure=pressure.copy(), fill=fill.copy())
                ask = partial(against_exact, slider(theta, liquid(modulus)), cells, start)
                row, column = f"{name}, {cells} cells", f"β = {modulus:g} GPa, θ = {theta:g}"
                yield film_probe("wrong starts", row, column, ask, bound(cells))


def _laws() -> Iterator[Probe]:
    """Sliders with laws of density and viscosity at high pressure."""
    density, viscosity = DowsonHigginson(law="dowson_higginson"), Roelands(law="roelands", index=0.6)
    laws = {
        "Dowson and Higginson": {"compressibility": density},
        "Roelands, Z = 0.6": {"piezoviscosity": viscosity},
        "both": {"compressibility": density, "piezoviscosity": viscosity},
    }
    for (name, given), factor in product(laws.items(), (1, 10, 30)):
        problem = replace(slider(0.6, liquid(1.0)), speed=factor * SPEED, **given)  # type: ignore[arg-type]
        # the exact solution does not reach the 0.8 GPa of both laws at 137 m/s
        ask, allowed = partial(against_exact, problem, CELLS), bound(CELLS)
        if name == "both" and factor == 30:
            ask, allowed = partial(balance, problem, (CELLS, 1)), BALANCE_TOLERANCE
        yield film_probe("laws", name, f"{factor * SPEED:.3g} m/s", ask, allowed)


def _steps() -> Iterator[Probe]:
    """Steps of the film thickness: Rayleigh's load if the film narrows, no load if it widens."""
    group = "jumps of the film"
    for jump in (2.0, 10.0, 100.0, 1000.0):
        rise, place = metres((jump - 1) * FILM), metres(0.7 * LENGTH)
        shape = Step(shape="step", length=metres(LENGTH), film=metres(FILM), rise=rise, step=place).film_shape()
        load = rayleigh_step(
            film=FILM, rise=(jump - 1) * FILM, length=LENGTH, step=0.7 * LENGTH, speed=SPEED, viscosity=VISCOSITY
        ).load
        row = f"down to 1/{jump:g}"
        for cells in (10, 101, CELLS):
            ask = partial(against, film(shape, Ends()), cells, partial(float, load))
            yield film_probe(group, row, f"{cells} cells", ask, 1e-9)
        ask = partial(against, film(mirrored(shape), Ends()), CELLS, float)
        yield film_probe(group, f"up to {jump:g} times", f"{CELLS} cells", ask, ROUND_OFF)
        for theta in (0.5, 0.05):
            problem = film(shape, Ends(theta=theta), compressibility=liquid(0.3))
            ask = partial(balance, problem, (CELLS, 1))
            yield film_probe(group, row, f"θ = {theta:g}", ask, BALANCE_TOLERANCE)


def _pockets() -> Iterator[Probe]:
    """Infinitely wide films with many cavities, judged by their balance of flows."""
    random = np.random.default_rng(SEED + 1)
    parallel = Parallel(shape="parallel", length=metres(LENGTH), film=metres(FILM)).film_shape()
    shapes: dict[str, Shape] = {}
    for columns in (1, 3, 10, 40):
        pitch = LENGTH / columns
        lengths = {"length": 0.5 * pitch, "depth": FILM, "start": 0.2 * pitch, "pitch": pitch}
        for profile in ("box", "cylindrical"):
            given = {name: metres(value) for name, value in lengths.items()}
            texture = Texture(profile=profile, columns=columns, **given)  # type: ignore[arg-type]
            shapes[f"{columns} {profile} pockets"] = pocketed(parallel, texture)
    shapes |= {f"{count} parabolas": parabola(count=count) for count in (2, 8)}
    shapes["journal, ε = 0.99"] = Journal.model_validate(
        {"shape": "journal", "radius": "12 mm", "clearance": "60 um", "eccentricity": 0.99}
    ).film_shape()
    places = np.linspace(0, LENGTH, 301)
    heights = FILM * random.uniform(0.2, 2.0, places.size)
    shapes["random film"] = replace(parallel, thickness=lambda x, y: np.interp(x, places, heights) + 0 * y)
    trials = {
        "flooded, β = 0.05 GPa": (Ends(), liquid(0.05)),
        "flooded, β = 100 GPa": (Ends(), liquid(100.0)),
        "θ = 0.6, β = 0.05 GPa": (Ends(theta=0.6), liquid(0.05)),
        "θ = 0.95, β = 1 GPa": (Ends(theta=0.95), liquid(1.0)),
        "1 MPa at both ends": (Ends(inlet=1e6, outlet=1e6), liquid(1.0)),
    }
    for (name, shape), (column, (ends, law)) in product(shapes.items(), trials.items()):
        ask = partial(balance, film(shape, ends, compressibility=law), (2 * CELLS, 1))
        yield film_probe("many cavities", name, column, ask, BALANCE_TOLERANCE)


def _in_the_plane(cells: tuple[int, int]) -> Iterator[Probe]:
    """Films of finite width on small grids: sliders, pockets, and sectors that are separate or joined."""
    group, open_sides = "in the plane", (0.0, 0.0)
    ratios = (0.1, 1.0, 10.0)
    shapes = {f"parabola, width/length {ratio:g}": parabola(width=metres(ratio * LENGTH)) for ratio in ratios}
    lengths = {"length": 0.1, "width": 0.15, "start": 0.05, "pitch": 0.2, "pitch_across": 0.3}
    given = {name: metres(part * LENGTH) for name, part in lengths.items()} | {"depth": metres(FILM)}
    pocket = Texture(profile="ellipsoidal", columns=4, rows=3, **given)
    plate = Parallel(shape="parallel", length=metres(LENGTH), width=metres(LENGTH), film=metres(FILM)).film_shape()
    shapes["12 pockets"] = pocketed(plate, pocket)
    trials = {
        "flooded": (Ends(sides=open_sides), liquid(0.1)),
        "θ = 0.6": (Ends(theta=0.6, sides=open_sides), liquid(0.1)),
        "θ = 0.1": (Ends(theta=0.1, sides=open_sides), liquid(0.1)),
        "β = 100 GPa": (Ends(sides=open_sides), liquid(100.0)),
        "0.1 MPa around": (Ends(inlet=1e5, outlet=1e5, sides=(1e5, 1e5)), liquid(1.0)),
        "closed sides": (Ends(theta=0.6), liquid(1.0)),
    }
    for (name, shape), (column, (ends, law)) in product(shapes.items(), trials.items()):
        ask = partial(balance, film(shape, ends, compressibility=law), cells)
        yield film_probe(group, name, column, ask, BALANCE_TOLERANCE)
    for joined, pressure in product((False, True), (0.0, 1e5)):
        radii = {"inner_radius": "30 mm", "outer_radius": "60 mm", "angle": "45 deg"}
        films = {"film": f"{FILM!r} m", "rise": f"{FILM!r} m", "taper": 0.7}
        sector = Sector.model_validate({"shape": "sector", **radii, **films, "joined": joined})
        ends = Ends(inlet=pressure, outlet=pressure, sides=(pressure, pressure))
        problem = film(sector.film_shape(), ends, compressibility=liquid(1.0), speed=SPEED / sector.radius)
        row = "sector, joined" if joined else "sector"
        column = "0.1 MPa at the sides" if pressure else "no pressure at the sides"
        yield film_probe(group, row, column, partial(balance, problem, cells), BALANCE_TOLERANCE)


def _stiffening() -> Iterator[Probe]:
    """Linear sliders with Barus' law: no solution exists for α p0 >= 1, where p0 is the greatest reduced pressure."""
    reduced = linear_slider(film=FILM, rise=FILM, length=LENGTH, speed=SPEED, viscosity=VISCOSITY).pressure_max
    for alpha_p0, cells in product((0.5, 0.9, 0.99, 0.999, 1.001, 1.01, 1.1, 2.0, 10.0), (16, 200, 2 * CELLS)):
        if 0 < alpha_p0 - 1 < MAXIMUM_MISS_FACTOR / cells**2:
            continue  # no node is near enough to the greatest pressure
        ask, allowed = partial(_barus_error, reduced, alpha_p0, cells), bound(cells) / abs(1 - alpha_p0)
        yield film_probe("Barus", f"α p0 = {alpha_p0:g}", f"{cells} cells", ask, allowed, refused=alpha_p0 > 1)


def _barus_error(reduced: float, alpha_p0: float, cells: int) -> Answer:
    law = Barus(law="barus", pressure_coefficient=f"{alpha_p0 / reduced!r} Pa^-1")  # type: ignore[arg-type]
    solution = solve(film(linear(), Ends(), piezoviscosity=law), (cells, 1))
    truth = barus_pressure(reduced, alpha_p0 / reduced) if alpha_p0 < 1 else np.nan
    return steps_of(solution), abs(float(solution.state.pressure.max()) / truth - 1)
