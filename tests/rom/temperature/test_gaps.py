"""Films with gaps between them: what a gap passes on, whatever the walls are in it."""

from functools import cache

import numpy as np
import pytest

from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.evaluation.flows import flow_along
from roughfilm.rom.cavitation.grid import gaps
from roughfilm.rom.cavitation.problem import Inflow, Problem
from roughfilm.rom.cavitation.shape import Shape
from roughfilm.rom.cavitation.solve import solve
from roughfilm.rom.lubricants.liquid import Liquid
from roughfilm.rom.temperature.across import temperature_across
from roughfilm.rom.temperature.dissipation import film_flows, passed_on
from roughfilm.rom.temperature.mean import mean_temperature
from roughfilm.rom.temperature.walls import InsulatedWall, WallAtTemperature

T0, ETA, HEAT, SPEED, WIDTH = 313.15, 0.05, 1.7e6, 10.0, 0.08
TURN, GAPS = 0.3, ((0.12, 0.15), (0.27, 0.3))


def liquid(slope, conductivity=0.13):
    def viscosity(temperature):
        eta = ETA * np.exp(-slope * (temperature - T0))
        return eta, -slope * eta

    return Liquid(
        temperature=T0,
        viscosity=viscosity,
        heat=lambda temperature: (HEAT * (temperature - T0), HEAT + 0 * temperature),
        conductivity=conductivity,
    )


@cache
def film(depth, *, wide):
    """Two films of which each is thicker at its beginning or its end, with grooves of a depth between them."""

    def grooves(x):
        places = [np.clip((x - begin) / (end - begin), 0, 1) for begin, end in GAPS]
        return sum(np.sin(np.pi * place) for place in places)

    def ends(x, y):
        between = [(begin - 1e-9 <= x) & (x <= end + 1e-9) for begin, end in GAPS]
        return np.any([x <= 1e-9, *between], axis=0) & np.isfinite(y)

    shape = Shape(
        thickness=lambda x, y: 4e-5 * (1.2 + 0.6 * np.cos(2 * np.pi * x / TURN)) + depth * grooves(x) + 0 * y,
        breaks=(0.0, 0.12, 0.15, 0.27, TURN),
        across=(0.0, WIDTH),
        wide=wide,
        joined=(True, False),
        idle=GAPS,
    )
    return solve(
        Problem(
            shape=shape,
            ends=Ends(sides=None if wide else (0.0, 0.0)),
            speed=SPEED,
            viscosity=ETA,
            inflows=(Inflow(covers=ends, pressure=2e5),),
        ),
        (40, 1 if wide else 10),
    )


def inside(solution):
    """Whether the nodes of each x lie inside of a film."""
    return ~np.isin(np.arange(solution.grid.x.size), np.concatenate(gaps(solution.problem.shape, solution.grid)))


def mean_of(solution, carried_over):
    found = mean_temperature(solution, liquid(0.03), carried_over=carried_over)
    assert found.imbalance < 1e-10
    return found.temperature


def across_of(solution, carried_over):
    walls = {"sliding_wall": WallAtTemperature(temperature=T0 + 5), "fixed_wall": InsulatedWall()}
    found = temperature_across(solution, liquid(0.03), modes=4, carried_over=carried_over, **walls)
    heat = found.balance
    left = heat.leaving + heat.sliding_wall + heat.fixed_wall + heat.stored
    assert heat.dissipation + heat.entering == pytest.approx(left, abs=1e-7 * heat.dissipation)
    return found.mean


def test_a_gap_passes_on_what_leaves_one_film_as_far_as_the_next_one_takes_it():
    leaving, entering = np.array([3.0, 1.0, -1.0, 2.0]), np.array([2.0, 4.0, 1.0, -1.0])
    np.testing.assert_array_equal(passed_on(leaving, entering, 1.0), [2.0, 1.0, 0.0, 0.0])
    np.testing.assert_array_equal(passed_on(leaving, entering, 0.5), [1.5, 0.5, 0.0, 0.0])


@pytest.mark.parametrize("wide", [True, False], ids=["wide", "with sides"])
@pytest.mark.parametrize("carried_over", [1.0, 0.6])
def test_the_thickness_in_a_gap_has_no_effect(wide, carried_over):
    """Sliding would carry a half of the thickness through a gap, and new lubricant would fill it."""
    flat, deep = film(0.0, wide=wide), film(1e-4, wide=wide)
    within = inside(flat)
    assert within.sum() == flat.grid.x.size - sum(nodes.size for nodes in gaps(flat.problem.shape, flat.grid))
    one, other = mean_of(flat, carried_over), mean_of(deep, carried_over)
    assert one[within].max() > T0 + 5
    np.testing.assert_allclose(other[within], one[within], atol=1e-6)
    if wide:
        one, other = across_of(flat, carried_over), across_of(deep, carried_over)
        np.testing.assert_allclose(other[within], one[within], atol=0.05)


def test_what_enters_at_a_gap_is_what_the_next_film_takes_beyond_what_is_passed_on():
    solution = film(0.0, wide=False)
    along, flows = flow_along(solution), film_flows(solution, 0.8)
    for nodes in gaps(solution.problem.shape, solution.grid):
        out, into = along[nodes[0] - 1], along[nodes[-1]]
        passed = passed_on(out, into, 0.8)
        np.testing.assert_allclose(flows.entering[nodes[0]], passed - out, atol=1e-20)
        np.testing.assert_allclose(flows.entering[nodes[-1]], into - passed, atol=1e-20)
        np.testing.assert_allclose(flows.entering[nodes[1:-1]], 0.0, atol=1e-20)


@pytest.mark.parametrize("carried_over", [1.0, 0.5])
def test_fast_conduction_across_the_film_gives_the_mean_temperature(carried_over):
    solution, insulated = film(0.0, wide=True), InsulatedWall()
    oil, within = liquid(0.03, conductivity=130.0), inside(film(0.0, wide=True))
    mean = mean_temperature(solution, oil, carried_over=carried_over).temperature[within]
    walls = {"sliding_wall": insulated, "fixed_wall": insulated}
    across = temperature_across(solution, oil, modes=3, carried_over=carried_over, **walls).mean[within]
    np.testing.assert_allclose(across - T0, mean - T0, rtol=0.02)
