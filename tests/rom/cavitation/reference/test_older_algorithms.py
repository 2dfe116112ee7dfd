"""The older algorithms against the exact film, where they converge, and how they fail elsewhere."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome
from roughfilm.rom.bearing.closed_forms.sliding import linear_slider, rayleigh_step
from roughfilm.rom.bearing.geometry.shapes import Linear, Parabolic, Step
from roughfilm.rom.cavitation.discretise import Ends, faces, network
from roughfilm.rom.cavitation.exact import exact
from roughfilm.rom.cavitation.grid import grid
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.reference.fischer_burmeister import fischer_burmeister
from roughfilm.rom.cavitation.reference.switch import switched
from roughfilm.rom.lubricants.compressibility import ConstantBulkModulus, DowsonHigginson, Incompressible

SPEED, VISCOSITY, UNIT = 4.57, 0.039, 1.26e8
SHAPE = Parabolic(shape="parabolic", length="76.2 mm", film="25.4 um", rise="25.4 um").film_shape()
SOFT = ConstantBulkModulus(law="constant_bulk_modulus", bulk_modulus="0.07 GPa")
STIFF = ConstantBulkModulus(law="constant_bulk_modulus", bulk_modulus="10 GPa")
MINERAL = DowsonHigginson(law="dowson_higginson", c1="2.22 GPa", c2=1.66)


def slider(theta=1.0, law=SOFT, **given):
    return Problem(
        **{
            "shape": SHAPE,
            "ends": Ends(theta=theta),
            "speed": SPEED,
            "viscosity": VISCOSITY,
            "compressibility": law,
            **given,
        }
    )


def schur(problem, cells, **given):
    nodes = grid(problem.shape, (cells, 1))
    net = network(
        nodes,
        faces(problem.shape, nodes),
        problem.ends,
        speed=problem.speed,
        viscosity=problem.viscosity,
        compressibility=problem.initial_compressibility,
    )
    found = fischer_burmeister(net, problem, pressure_unit=UNIT, **given)
    return found, float((nodes.areas * found.state.pressure).sum())


@pytest.mark.parametrize(
    ("theta", "law"),
    [(0.52, SOFT), (0.55, SOFT), (1.0, SOFT), (0.52, STIFF), (0.55, STIFF), (1.0, STIFF), (1.0, MINERAL)],
)
def test_the_switch_algorithm_comes_near_the_exact_film(theta, law):
    known = exact(slider(theta, law)).load
    errors = [abs(switched(slider(theta, law), cells).load / known - 1) for cells in (100, 400)]
    assert errors[0] < 0.02
    assert errors[1] < errors[0] / 8


def test_the_switch_algorithm_has_pressure_only_where_the_film_is():
    found = switched(slider(0.55), 200)
    known = exact(slider(0.55))
    place = found.grid.x / 76.2e-3
    assert (found.pressure[place < known.film_start - 0.01] == 0).all()
    assert (found.pressure[place > known.rupture + 0.01] == 0).all()
    assert ((found.pressure > 0) == (found.theta > 1)).all()
    assert found.theta[0] == 0.55


def test_the_switch_algorithm_moves_the_film_by_a_node_a_step():
    steps = [switched(slider(0.55), cells).iterations for cells in (100, 200, 400)]
    assert steps[1] / steps[0] == pytest.approx(2, rel=0.3)
    assert steps[2] / steps[1] == pytest.approx(2, rel=0.3)
    with pytest.raises(ConvergenceError, match="after 30 steps") as raised:
        switched(slider(0.55), 400, limit=30)
    assert raised.value.outcome is Outcome.UNFINISHED
    assert raised.value.iterations == 30


def test_the_switch_algorithm_stops_when_it_stalls():
    """In a very stiff film the density of one node oscillates; the solver stops before its limit of steps."""
    law = ConstantBulkModulus(law="constant_bulk_modulus", bulk_modulus="100 GPa")
    with pytest.raises(ConvergenceError, match="at a constant switch") as raised:
        switched(slider(0.55, law), 1000)
    assert raised.value.outcome is Outcome.STALLED
    assert raised.value.iterations < 1000


def test_the_switch_algorithm_takes_a_pressurised_inlet():
    """Its own paper's case: θ = 1.0001 at the inlet."""
    pressure = SOFT.pressure_at(1.0001)
    problem = slider(ends=Ends(inlet=pressure))
    assert switched(problem, 1000).load == pytest.approx(exact(problem).load, rel=1e-4)


@pytest.mark.parametrize(
    ("given", "match"),
    [({"compressibility": Incompressible()}, "compressibility"), ({"speed": -1.0}, "reversed")],
)
def test_the_switch_algorithm_refuses_what_it_cannot(given, match):
    with pytest.raises(InputError, match=match):
        switched(slider(**given), 100)


def test_the_switch_algorithm_states_densities_that_no_pressure_has():
    law = DowsonHigginson(law="dowson_higginson", c1="0.1 GPa", c2=1.0005)
    with pytest.raises(ConvergenceError, match="densities") as raised:
        switched(slider(law=law), 100)
    assert raised.value.outcome is Outcome.DIVERGED


@pytest.mark.parametrize("theta", [0.2, 0.55, 0.8, 1.0])
@pytest.mark.parametrize("law", [SOFT, STIFF, MINERAL, Incompressible()])
def test_fischer_burmeister_comes_near_the_exact_film_in_a_few_steps(theta, law):
    known = exact(slider(theta, law)).load
    found, load = schur(slider(theta, law), 400)
    assert load == pytest.approx(known, rel=1e-4, abs=1e-6)
    assert found.iterations <= 10
    assert (found.state.pressure >= 0).all()
    assert (found.state.fill <= 1).all()
    assert (np.minimum(found.state.pressure[1:-1] / UNIT, 1 - found.state.fill[1:-1]) < 1e-8).all()


def test_fischer_burmeister_meets_closed_forms():
    shape = Linear(shape="linear", length="50 mm", film="20 um", rise="24 um").film_shape()
    known = linear_slider(film=20e-6, rise=24e-6, length=0.05, speed=SPEED, viscosity=VISCOSITY)
    _, load = schur(slider(law=Incompressible(), shape=shape), 1000)
    assert load == pytest.approx(known.load, rel=1e-5)
    shape = Step(shape="step", length="50 mm", film="20 um", rise="1980 um", step="35 mm").film_shape()
    known = rayleigh_step(film=20e-6, rise=1980e-6, length=0.05, step=0.035, speed=SPEED, viscosity=VISCOSITY)
    for theta in (1.0, 0.05):
        _, load = schur(slider(theta, Incompressible(), shape=shape), 100)
        assert load == pytest.approx(known.load, rel=1e-6)


def test_fischer_burmeister_says_when_it_does_not_meet_its_tolerance():
    with pytest.raises(ConvergenceError, match="after 2 steps") as raised:
        schur(slider(), 400, limit=2)
    assert raised.value.iterations == 2


def test_fischer_burmeister_is_for_lines():
    sides = Parabolic(shape="parabolic", length="76.2 mm", width="20 mm", film="25.4 um", rise="25.4 um").film_shape()
    problem = slider(shape=sides)
    nodes = grid(sides, (8, 8))
    net = network(nodes, faces(sides, nodes), problem.ends, speed=1.0, viscosity=1.0, compressibility=0.0)
    with pytest.raises(InputError, match="open line"):
        fischer_burmeister(net, problem, pressure_unit=UNIT)
