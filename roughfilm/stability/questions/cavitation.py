"""What the default solver of cavitating films is tried on, each question with a judge of its own."""

from collections.abc import Iterator
from dataclasses import replace
from functools import partial

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.closed_forms import barus_pressure, linear_slider, rayleigh_step
from roughfilm.rom.bearing.ring import Sector
from roughfilm.rom.bearing.shapes import Journal, Parabolic, Parallel, Step
from roughfilm.rom.bearing.texture import Texture, pocketed
from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.network import State
from roughfilm.rom.cavitation.shape import Shape
from roughfilm.rom.cavitation.solve import solve
from roughfilm.rom.lubricants.compressibility import DowsonHigginson
from roughfilm.rom.lubricants.viscosity import Barus, Roelands
from roughfilm.stability.questions.films import (
    BALANCED,
    CELLS,
    FILM,
    LENGTH,
    REFUSED,
    SAME,
    SEED,
    SOLVED,
    SPEED,
    UNIT,
    VISCOSITY,
    Answer,
    Probe,
    against,
    balance,
    bound,
    film,
    known_load,
    linear,
    liquid,
    load_of,
    metres,
    mirrored,
    off,
    slider,
    steps_of,
)

PLANE = (32, 24)
"""In the plane."""

NEAR = 10
"""A node misses the greatest pressure by up to about so much times (cell/length)² of it."""


def probes(plane: tuple[int, int] = PLANE) -> Iterator[Probe]:
    """Every question; those in the plane on so many cells."""
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
    """The wall turned round, film and all: what it gives must be the same."""
    texture = Texture(length=metres(6e-3), depth=metres(1e-5), start=metres(8e-3), pitch=metres(2e-2), columns=3)
    shapes = {"linear": linear(), "textured": pocketed(linear(), texture)}
    for name, shape in shapes.items():
        for label, ends in {"flooded": Ends(), "starved": Ends(theta=0.52), "pressurised": Ends(inlet=UNIT)}.items():

            def ask(shape: Shape = shape, ends: Ends = ends) -> Answer:
                forward = solve(film(shape, ends, compressibility=liquid(0.1)), (CELLS, 1))
                there = film(mirrored(shape), ends, compressibility=liquid(0.1), speed=-SPEED)
                back = solve(there, (CELLS, 1))
                apart = np.abs(forward.state.pressure - back.state.pressure).max() / UNIT
                unlike = np.abs(forward.state.fill - back.state.fill).max()
                return Answer(iterations=steps_of(back), error=float(max(apart, unlike)))

            yield Probe(group="reversed sliding", row=name, column=label, ask=ask, bound=SAME)


def _at_rest() -> Iterator[Probe]:
    """Nothing slides: with β, θ falls as ∫h⁻³ does; of constant density, p does."""
    for name, pressure in {"no pressure": 0.0, "inlet 0.01 MPa": 1e4, "inlet 10 MPa": 1e7}.items():
        for column, modulus in {"incompressible": None, "β = 0.05 GPa": 0.05}.items():

            def ask(pressure: float = pressure, modulus: float | None = modulus) -> Answer:
                given = {} if modulus is None else {"compressibility": liquid(modulus)}
                found = solve(film(linear(), Ends(inlet=pressure), speed=0.0, **given), (CELLS, 1))
                # ∫ h⁻³ dx of h = FILM (2 - x/L) from 0 to x, over that to L
                part = ((2 - found.grid.x / LENGTH) ** -2 - 0.25) / 0.75
                if modulus is None:
                    wanted = pressure * (1 - part)
                else:
                    theta = 1 + np.expm1(pressure / (modulus * 1e9)) * (1 - part)
                    wanted = modulus * 1e9 * np.log(theta)
                apart = np.abs(found.state.pressure[:, 0] - wanted).max() / (pressure or UNIT)
                return Answer(iterations=steps_of(found), error=float(apart))

            yield Probe(group="at rest", row=name, column=column, ask=ask, bound=bound(CELLS))

    def starved() -> Answer:
        found = solve(film(linear(), Ends(theta=0.5), speed=0.0), (CELLS, 1))
        return Answer(iterations=steps_of(found), error=off(load_of(found), 0.0))

    yield Probe(group="at rest", row="nothing is brought", column="θ = 0.5", ask=starved, bound=SAME)


def _starved() -> Iterator[Probe]:
    """Round θ = 1/2, where the parabolic slider's film appears, and far below."""
    for theta in (1e-12, 1e-6, 1e-3, 0.3, 0.4999, 0.5, 0.5001, 0.501, 0.51):
        for modulus in (0.05, 100.0):
            problem = slider(theta, liquid(modulus))
            ask = partial(against, problem, 10 * CELLS, partial(known_load, problem))
            # without a film errors count over the unit, of which the flooded slider carries a hundredth; a film that
            # is a few cells long is known no better than so
            allowed = bound(10 * CELLS) / 100 if theta < 0.5001 else 0.1 if theta < 0.501 else 0.01
            yield Probe(
                group="very starved",
                row=f"β = {modulus:g} GPa",
                column=f"θ = {theta:g}",
                ask=ask,
                bound=allowed,
            )


def _restarted() -> Iterator[Probe]:
    """From states that are far from what is sought; no coarser grid helps."""
    random = np.random.default_rng(SEED)
    for cells in (200, 10 * CELLS):
        shape = (cells + 1, 1)
        noise = random.random(shape)
        fields: dict[str, tuple[Array, Array]] = {
            "full, no pressure": (np.zeros(shape), np.ones(shape)),
            "nothing but cavity": (np.zeros(shape), np.zeros(shape)),
            "1 GPa everywhere": (np.full(shape, 1e9), np.ones(shape)),
            "random": (np.where(noise > 0.5, noise * UNIT, 0.0), np.where(noise > 0.5, 1.0, noise)),
        }
        for modulus in (0.05, 1.0, 100.0):
            other = solve(slider(1.0 if modulus == 1 else 0.55, liquid(10.0)), (cells, 1)).state
            for name, (pressure, fill) in {**fields, "another slider": (other.pressure, other.fill)}.items():
                for theta in (0.2, 0.55, 1.0):
                    problem = slider(theta, liquid(modulus))
                    yield Probe(
                        group="wrong starts",
                        row=f"{name}, {cells} cells",
                        column=f"β = {modulus:g} GPa, θ = {theta:g}",
                        ask=partial(
                            against,
                            problem,
                            cells,
                            partial(known_load, problem),
                            State(pressure=pressure.copy(), fill=fill.copy()),
                        ),
                        bound=bound(cells),
                    )


def _laws() -> Iterator[Probe]:
    """Laws that follow pressures further."""
    laws = {
        "Dowson and Higginson": {"compressibility": DowsonHigginson(law="dowson_higginson")},
        "Roelands, Z = 0.6": {"piezoviscosity": Roelands(law="roelands", index=0.6)},
        "both": {
            "compressibility": DowsonHigginson(law="dowson_higginson"),
            "piezoviscosity": Roelands(law="roelands", index=0.6),
        },
    }
    for name, given in laws.items():
        for column, speed in {"4.57 m/s": SPEED, "45.7 m/s": 10 * SPEED, "137 m/s": 30 * SPEED}.items():
            problem = replace(slider(0.6, liquid(1.0)), speed=speed, **given)  # type: ignore[arg-type]
            # 0.8 GPa at 137 m/s is more than the exact solution reaches
            known = name != "both" or speed < 30 * SPEED
            yield Probe(
                group="laws",
                row=name,
                column=column,
                ask=partial(against, problem, CELLS, partial(known_load, problem))
                if known
                else partial(balance, problem, (CELLS, 1)),
                bound=bound(CELLS) if known else BALANCED,
            )


def _steps() -> Iterator[Probe]:
    """Film thickness that jumps: towards the narrow side Rayleigh's step, towards the wide one nothing is borne."""
    for jump in (2.0, 10.0, 100.0, 1000.0):
        rise, place = metres((jump - 1) * FILM), metres(0.7 * LENGTH)
        shape = Step(shape="step", length=metres(LENGTH), film=metres(FILM), rise=rise, step=place).film_shape()
        wanted = rayleigh_step(
            film=FILM,
            rise=(jump - 1) * FILM,
            length=LENGTH,
            step=0.7 * LENGTH,
            speed=SPEED,
            viscosity=VISCOSITY,
        ).load
        for cells in (10, 101, CELLS):
            yield Probe(
                group="jumps of the film",
                row=f"down to 1/{jump:g}",
                column=f"{cells} cells",
                ask=partial(against, film(shape, Ends()), cells, partial(float, wanted)),
                bound=1e-9,
            )
        yield Probe(
            group="jumps of the film",
            row=f"up to {jump:g} times",
            column=f"{CELLS} cells",
            ask=partial(against, film(mirrored(shape), Ends()), CELLS, float),
            bound=SAME,
        )
        for theta in (0.5, 0.05):
            yield Probe(
                group="jumps of the film",
                row=f"down to 1/{jump:g}",
                column=f"θ = {theta:g}",
                ask=partial(balance, film(shape, Ends(theta=theta), compressibility=liquid(0.3)), (CELLS, 1)),
                bound=BALANCED,
            )


def _pockets() -> Iterator[Probe]:
    """Lines with many cavities, judged by their balance."""
    random = np.random.default_rng(SEED + 1)
    parallel = Parallel(shape="parallel", length=metres(LENGTH), film=metres(FILM)).film_shape()
    shapes: dict[str, Shape] = {}
    for columns in (1, 3, 10, 40):
        pitch = LENGTH / columns
        for profile in ("box", "cylindrical"):
            texture = Texture(
                profile=profile,
                length=metres(0.5 * pitch),
                depth=metres(FILM),
                start=metres(0.2 * pitch),
                pitch=metres(pitch),
                columns=columns,
            )
            shapes[f"{columns} {profile} pockets"] = pocketed(parallel, texture)
    for count in (2, 8):
        shapes[f"{count} parabolas"] = Parabolic(
            shape="parabolic", length=metres(LENGTH), film=metres(FILM), rise=metres(FILM), count=count
        ).film_shape()
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
    for name, shape in shapes.items():
        for column, (ends, law) in trials.items():
            problem = film(shape, ends, compressibility=law)
            yield Probe(
                group="many cavities",
                row=name,
                column=column,
                ask=partial(balance, problem, (2 * CELLS, 1)),
                bound=BALANCED,
            )


def _in_the_plane(cells: tuple[int, int]) -> Iterator[Probe]:
    """Finite width, small: sliders, sectors with and without a groove between them, pockets."""
    open_sides = (0.0, 0.0)
    shapes: dict[str, Shape] = {}
    for ratio in (0.1, 1.0, 10.0):
        shapes[f"parabola, width/length {ratio:g}"] = Parabolic(
            shape="parabolic", length=metres(LENGTH), width=metres(ratio * LENGTH), film=metres(FILM), rise=metres(FILM)
        ).film_shape()
    pocket = Texture(
        profile="ellipsoidal",
        length=metres(0.1 * LENGTH),
        width=metres(0.15 * LENGTH),
        depth=metres(FILM),
        start=metres(0.05 * LENGTH),
        pitch=metres(0.2 * LENGTH),
        columns=4,
        pitch_across=metres(0.3 * LENGTH),
        rows=3,
    )
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
    for name, shape in shapes.items():
        for column, (ends, law) in trials.items():
            yield Probe(
                group="in the plane",
                row=name,
                column=column,
                ask=partial(balance, film(shape, ends, compressibility=law), cells),
                bound=BALANCED,
            )
    for joined in (False, True):
        radii = {"inner_radius": "30 mm", "outer_radius": "60 mm", "angle": "45 deg"}
        films = {"film": f"{FILM!r} m", "rise": f"{FILM!r} m", "taper": 0.7}
        sector = Sector.model_validate({"shape": "sector", **radii, **films, "joined": joined})
        for column, pressure in {"no pressure at the sides": 0.0, "0.1 MPa at the sides": 1e5}.items():
            ends = Ends(inlet=pressure, outlet=pressure, sides=(pressure, pressure))
            problem = film(sector.film_shape(), ends, compressibility=liquid(1.0), speed=SPEED / sector.radius)
            yield Probe(
                group="in the plane",
                row="sector, joined" if joined else "sector",
                column=column,
                ask=partial(balance, problem, cells),
                bound=BALANCED,
            )


def _stiffening() -> Iterator[Probe]:
    """Barus' law on the linear slider: with α p0 the greatest reduced pressure, none exists from α p0 = 1 on."""
    reduced = linear_slider(film=FILM, rise=FILM, length=LENGTH, speed=SPEED, viscosity=VISCOSITY).pressure_max
    for part in (0.5, 0.9, 0.99, 0.999, 1.001, 1.01, 1.1, 2.0, 10.0):
        for cells in (16, 200, 2 * CELLS):
            if 0 < part - 1 < NEAR / cells**2:
                continue  # no node is near enough to the greatest pressure to tell

            def ask(part: float = part, cells: int = cells) -> Answer:
                law = Barus(law="barus", pressure_coefficient=f"{part / reduced!r} Pa^-1")  # type: ignore[arg-type]
                found = solve(film(linear(), Ends(), piezoviscosity=law), (cells, 1))
                wanted = barus_pressure(reduced, part / reduced) if part < 1 else np.nan
                greatest = float(found.state.pressure.max())
                return Answer(iterations=steps_of(found), error=abs(greatest / wanted - 1))

            yield Probe(
                group="Barus",
                row=f"α p0 = {part:g}",
                column=f"{cells} cells",
                ask=ask,
                bound=bound(cells) / abs(1 - part),
                expected=SOLVED if part < 1 else REFUSED,
            )
