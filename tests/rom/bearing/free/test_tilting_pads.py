"""Journal bearings with tilting pads: no cross-coupling, unloaded pads, and moments of misaligned shafts."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import find
from roughfilm.rom.bearing.dynamics.whirl import condensed
from roughfilm.rom.bearing.free.equilibrium import equilibrium, holding, refined
from roughfilm.rom.bearing.free.film import free_film
from roughfilm.rom.bearing.free.idle import idle_pads
from roughfilm.rom.bearing.quantities import shaft_moments
from roughfilm.rom.cavitation.motion.coefficients import coefficients
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

CLEARANCE, RADIUS = 1e-4, 0.05
BORE = {"shape": "lobes", "radius": "50 mm", "clearance": "100 um", "width": "50 mm"}
FOUR = BORE | {"lobes": 4, "arc": "80 deg", "pivot": 0.5}
FIVE = BORE | {"lobes": 5, "arc": "60 deg", "pivot": 0.5}


def scene(geometry, *, force="5 kN", cavitation="0 Pa", load=None, inlet="0 Pa"):
    return read_scene(
        {
            "name": "pads",
            "kind": "bearing",
            "geometry": geometry,
            "lubricant": {"viscosity": "20 mPa*s", "cavitation_pressure": cavitation},
            "motion": {"speed": "3000 rpm"},
            "load": {"force": force} | (load or {}),
            "boundary": {"inlet": {"pressure": inlet}},
        }
    )


def settled(geometry, *, cells=(60, 12), **entries):
    film = free_film(scene(geometry, **entries), cells)
    return film, equilibrium(film, None, tolerance=1e-10)


@pytest.mark.parametrize(
    "geometry",
    [FOUR | {"first": "-45 deg"}, FOUR | {"preload": 0.4}, FIVE, FIVE | {"preload": 0.3, "first": "-54 deg"}],
)
def test_symmetric_pads_with_central_pivots_have_no_cross_coupling(geometry):
    """The shaft moves along the load, and slow motions across it meet no force along it (Lund 1964)."""
    film, instant = settled(geometry)
    x, y = instant.place[:2] / CLEARANCE
    assert abs(x) < 1e-4 < -y
    whole = coefficients(film.solved, instant, speed=film.solved.problem.speed)
    kept = ~film.wall.turns
    stiffness, damping = condensed(whole.stiffness + holding(film, film.load), whole.damping, kept, 0.0)
    assert abs(stiffness[0, 1]) + abs(stiffness[1, 0]) < 1e-4 * stiffness[1, 1]
    assert abs(damping[0, 1]) + abs(damping[1, 0]) < 1e-4 * damping[1, 1]
    assert stiffness[1, 1] > 0 < damping[1, 1]


def test_a_shaft_between_parallel_films_stays_in_the_middle():
    """The pads beside a shaft without preload follow it: their films are parallel, and have no force across the load.

    At this place their films begin to carry, so that there is no one stiffness.
    """
    instant = settled(FOUR)[1]
    assert abs(instant.place[0]) < 1e-4 * CLEARANCE
    assert instant.place[3] * RADIUS == pytest.approx(-instant.place[1], rel=1e-4)
    assert instant.place[5] * RADIUS == pytest.approx(instant.place[1], rel=1e-4)


def test_a_fine_grid_keeps_the_place_of_pads_without_a_load():
    coarse, first = settled(FOUR | {"first": "-45 deg"}, cells=(48, 8))
    fine = free_film(coarse.scene, (96, 16))
    instant = equilibrium(fine, refined(coarse, first, fine), tolerance=1e-10)
    assert instant.place[:2] == pytest.approx(first.place[:2], abs=0.02 * CLEARANCE)
    assert instant.place[2:] * RADIUS == pytest.approx(first.place[2:] * RADIUS, abs=0.05 * CLEARANCE)


def test_pads_without_a_load_are_named():
    result = find("bearing", "reynolds_cavitating").solve(
        scene(FOUR | {"first": "-45 deg"}, force="20 kN"), Request(resolution=48)
    )
    assert any("pads 2, 3 carry no load" in warning for warning in result.warnings)
    assert result["tilt_1"].value > 0
    light = find("bearing", "reynolds_cavitating").solve(
        scene(FOUR | {"preload": 0.5}, force="500 N"), Request(resolution=48)
    )
    assert not any("no load" in warning for warning in light.warnings)


@pytest.mark.parametrize("preload", [0.0, 0.6])
@pytest.mark.parametrize("pivot", [0.5, 0.6])
@pytest.mark.parametrize("force", ["100 N", "5 kN", "200 kN"])
def test_pads_carry_light_and_heavy_loads_from_nothing(preload, pivot, force):
    film, instant = settled(FIVE | {"preload": preload, "pivot": pivot, "offset": pivot}, force=force, cells=(45, 6))
    assert film.solved.force(instant.state.pressure)[:2] == pytest.approx(-film.load[:2], abs=1e-6 * film.load[1] ** 2)
    assert instant.faces.thickness.min() > 0


def test_the_pressure_in_the_gaps_acts_on_the_shaft_alone():
    """The trapezoidal rule over each pad gives no moment about its pivot; over the circle it gives the load."""
    film, instant = settled(FOUR | {"first": "-45 deg", "preload": 0.4}, inlet="0.1 MPa", cells=(72, 8))
    solution, geometry = film.solution(instant), film.scene.geometry
    x, pressure = np.append(solution.grid.x, 2 * np.pi * RADIUS), solution.state.pressure @ solution.grid.volume_y
    pressure, angle = np.append(pressure, pressure[0]), geometry.start + x / RADIUS
    along, up = (-np.trapezoid(pressure * side(angle), x) for side in (np.cos, np.sin))
    assert [along, up] == pytest.approx(-film.load[:2], abs=1e-6 * 5e3)
    for pad, pivot in enumerate(geometry.pivots):
        begin = RADIUS * geometry.begins(pad)
        inside = (x > begin - 1e-9) & (x < begin + RADIUS * geometry.turn + 1e-9)
        moments = pressure[inside] * np.sin(angle[inside] - pivot)
        assert abs(np.trapezoid(moments, x[inside])) < 1e-5 * np.trapezoid(pressure[inside], x[inside])


def test_suction_that_closes_a_pad_is_one_line():
    """Where the cavity has suction, a pad without a load is drawn onto the shaft with its edge."""
    with pytest.raises(InputError, match=r"carries no load.*cavitation_pressure") as error:
        settled(FIVE, force="12 kN", cavitation="-0.1 MPa", cells=(30, 4))
    assert "\n" not in str(error.value)


def test_of_two_equilibria_that_in_which_all_pads_carry_load_is_found():
    """The load of a given place comes back to it; at the other equilibrium, 0.01 c away, pad 4 carries none."""
    pads = FIVE | {"preload": 0.4, "pivot": 0.6, "offset": 0.6}
    bearing = scene(pads | {"eccentricity": [0.13, -0.48]})
    given = free_film(bearing.model_copy(update={"load": None}), (40, 6))
    known = equilibrium(given, None, tolerance=1e-10)
    assert idle_pads(given, known) == []
    x, y = (-float(force) for force in given.solved.force(known.state.pressure)[:2])
    angle = float(np.degrees(np.arctan2(y, x)))
    film, instant = settled(pads, force=f"{np.hypot(x, y):.17g} N", load={"angle": f"{angle!r} deg"}, cells=(40, 6))
    assert idle_pads(film, instant) == []
    assert instant.place[:2] == pytest.approx(known.place[:2], abs=1e-6 * CLEARANCE)


def test_suction_does_not_keep_pads_from_the_tilts_at_which_they_carry_load():
    pads = {"lobes": 3, "arc": "100 deg", "preload": 0.2, "pivot": 0.6, "offset": 0.6}
    film, instant = settled(BORE | pads, force="3 kN", cavitation="-0.1 MPa", cells=(36, 6))
    assert idle_pads(film, instant) == []


def test_suction_that_no_film_meets_changes_no_equilibrium():
    """All films are full in equilibrium; on the way to it suction draws pad 4 onto the shaft."""
    pads = FIVE | {"pivot": 0.6, "offset": 0.6, "first": "-126 deg"}
    ambient, suction = (
        settled(pads, force="20 kN", cavitation=cavity, cells=(48, 8)) for cavity in ("0 Pa", "-30 kPa")
    )
    assert not (ambient[1].state.fill < 1).any()
    assert suction[1].place == pytest.approx(ambient[1].place, rel=1e-6)


def moments(along_x, along_y, place=(0.2, -0.5)):
    """The moments of a film on a misaligned shaft at a given place."""
    tilted = [f"{value!r} rad" for value in (along_x, along_y)]
    geometry = BORE | {"lobes": 2, "arc": "150 deg", "misalignment": tilted, "eccentricity": list(place)}
    entries = {"name": "shaft", "kind": "bearing", "geometry": geometry, "lubricant": {"viscosity": "20 mPa*s"}}
    film = free_film(read_scene({**entries, "motion": {"speed": "3000 rpm"}}), (48, 16))
    solution = film.solution(equilibrium(film, None, tolerance=1e-11))
    force = solution.grid.areas * solution.state.pressure
    found = shaft_moments(film.scene.geometry, solution.grid.x, solution.grid.y, force)
    return np.array([found["moment_x"][0], found["moment_y"][0]])


def test_moments_of_a_misaligned_shaft_are_odd_and_linear_in_small_angles():
    small, opposite, twice = moments(1e-6, 2e-6), moments(-1e-6, -2e-6), moments(2e-6, 4e-6)
    assert opposite == pytest.approx(-small, rel=1e-6)
    assert twice == pytest.approx(2 * small, rel=1e-3)
    alone = moments(1e-6, 0.0) + moments(0.0, 2e-6)
    assert alone == pytest.approx(small, rel=1e-3)


def test_the_moment_turns_a_misaligned_shaft_back():
    """A shaft below the middle that is inclined downwards towards its far end is pushed up there: M_x below 0."""
    assert moments(0.0, -1e-4, place=(0.0, -0.5))[0] < 0 < moments(0.0, 1e-4, place=(0.0, -0.5))[0]
