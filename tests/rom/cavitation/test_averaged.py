"""Films whose roughness is averaged: closed forms of ridges, manufactured pressures, mass, mirrors, limits."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.quantities import boundary_flows
from roughfilm.rom.cavitation.balance import CAVITY
from roughfilm.rom.cavitation.discretise import Ends, faces
from roughfilm.rom.cavitation.evaluation.flows import flow_along
from roughfilm.rom.cavitation.grid import grid
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.shape import Shape
from roughfilm.rom.cavitation.solve import solve
from roughfilm.rom.homogenization.flow_factors import flow_factors
from roughfilm.rom.homogenization.gap_factors import GapFactors
from roughfilm.rom.homogenization.ridges import sinusoidal_ridges
from roughfilm.rom.lubricants.compressibility import ConstantBulkModulus

LENGTH, WIDTH, FILM = 20e-3, 15e-3, 20e-6


def film(x, y):
    return FILM * (2 - x / LENGTH + 0.3 * y / WIDTH)


def pad(roughness=None, *, thickness=film, wide=False, width=WIDTH, speed=1.0, ends=None, **laws):
    shape = Shape(
        thickness=lambda x, y: thickness(x, y) + 0 * x + 0 * y,
        breaks=(0.0, LENGTH),
        across=(0.0, width),
        wide=wide,
        roughness=roughness,
    )
    ends = ends or Ends(inlet=0.0, sides=None if wide else (0.0, 0.0))
    return Problem(shape=shape, ends=ends, speed=speed, viscosity=0.1, **laws)


@pytest.mark.parametrize("waves", [(1, 0), (0, 1), (1, 1), (2, 1), (1, -1)])
def test_ridges_are_what_the_cell_problem_says(waves):
    n, size = 128, 1e-3
    x = np.arange(n) / n
    gap = 2e-6 + 1e-6 * np.sin(2 * np.pi * (waves[0] * x[:, None] + waves[1] * x))
    cell = flow_factors(gap, (size / n, size / n)).factors
    ridges = sinusoidal_ridges(1e-6, float(np.arctan2(waves[1], waves[0])))(np.array([2e-6]))
    expected = [cell.pressure[0, 0], cell.pressure[1, 1], cell.pressure[0, 1], *cell.shear]
    found = [ridges.along, ridges.across, ridges.cross, ridges.drag, ridges.drag_across]
    scales = np.array([8e-18] * 3 + [2e-6] * 2)
    assert np.concatenate(found) / scales == pytest.approx(np.array(expected) / scales, abs=1e-3)
    assert ridges.couette[0] == pytest.approx(cell.couette, rel=1e-3)
    assert ridges.shear_couette[0] * 2e-6 == pytest.approx(cell.shear_couette * 2e-6, abs=1e-3)


def test_ridges_across_are_means_of_powers():
    def mean(power):
        return quad(lambda s: (3 + 2 * np.sin(s)) ** power, 0, 2 * np.pi, epsabs=0)[0] / (2 * np.pi)

    found = sinusoidal_ridges(2.0, 0.0)(np.array([3.0]))
    assert found.along[0] == pytest.approx(1 / mean(-3), rel=1e-12)
    assert found.across[0] == pytest.approx(mean(3), rel=1e-12)
    assert found.drag[0] == pytest.approx(mean(-2) / mean(-3), rel=1e-12)
    assert found.couette[0] == pytest.approx(mean(-1), rel=1e-12)
    assert found.shear_couette[0] == pytest.approx(mean(-1) - mean(-2) ** 2 / mean(-3), rel=1e-12)
    along = sinusoidal_ridges(2.0, np.pi / 2)(np.array([3.0]))
    assert (along.along[0], along.drag[0]) == pytest.approx((mean(3), 3.0), rel=1e-12)
    assert along.shear_couette[0] == pytest.approx(0, abs=1e-15)


def test_walls_that_touch_are_refused():
    with pytest.raises(InputError, match="the walls would touch"):
        sinusoidal_ridges(1e-6, 0.0)(np.array([2e-6, 1e-6]))


@pytest.mark.parametrize("wide", [True, False])
def test_averaged_flatness_is_a_smooth_film(wide):
    nodes = grid(pad(wide=wide).shape, (24, 24))
    smooth, rough = (faces(pad(law, wide=wide).shape, nodes) for law in (None, sinusoidal_ridges(0.0, 0.4)))
    for name in ("thickness", "mean", "east", "north"):
        assert getattr(rough, name) == pytest.approx(getattr(smooth, name), rel=1e-13)
    assert solve(pad(sinusoidal_ridges(0.0, 0.4), wide=wide), (24, 24)).network.oblique is None


def manufactured(law, cells):
    """The largest error where p = P sin(πx/L) sin(πy/W), which a source in every volume brings about."""
    problem = pad(law)
    top = 2e5

    def flux(x, y):
        a, b = np.pi / LENGTH, np.pi / WIDTH
        slope_x = top * a * np.cos(a * x) * np.sin(b * y)
        slope_y = top * b * np.sin(a * x) * np.cos(b * y)
        f = law(problem.shape.thickness(x, y))
        twelve = 12 * problem.viscosity
        along = problem.speed / 2 * f.drag - (f.along * slope_x + f.cross * slope_y) / twelve
        return along, problem.speed / 2 * f.drag_across - (f.cross * slope_x + f.across * slope_y) / twelve

    def opening(x, y):
        d = 1e-6
        return -(flux(x + d, y)[0] - flux(x - d, y)[0] + flux(x, y + d)[1] - flux(x, y - d)[1]) / (2 * d)

    found = solve(replace(problem, opening=opening), (cells, cells), ruptures=False)
    x, y = np.broadcast_arrays(found.grid.x[:, None], found.grid.y)
    assert found.residual < 1e-9
    exact = top * np.sin(np.pi * x / LENGTH) * np.sin(np.pi * y / WIDTH)
    return float(np.abs(found.state.pressure - exact).max()) / top


def constant(mean_gap):
    """A with off-diagonals of 0.8 √(A₁₁ A₂₂), B of which half drifts across, the same at every mean gap."""
    one, cube = np.ones_like(mean_gap), FILM**3 * np.ones_like(mean_gap)
    return GapFactors(
        along=cube,
        across=4 * cube,
        cross=1.6 * cube,
        drag=FILM * one,
        drag_across=FILM / 2 * one,
        couette=one / FILM,
        shear_couette=0 * one,
        streaming=one / FILM,
        least=one * FILM / 4,
    )


@pytest.mark.parametrize("law", [constant, sinusoidal_ridges(0.8 * FILM, 0.9)])
def test_manufactured_pressures_are_met_at_second_order(law):
    errors = [manufactured(law, cells) for cells in (24, 48, 96)]
    assert errors[-1] < 2e-3
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2, abs=0.25)
    assert np.log2(errors[1] / errors[2]) == pytest.approx(2, abs=0.25)


def test_far_from_its_sides_a_pad_is_a_line():
    def plane(x, y):
        return FILM * (2 - x / LENGTH) + 0 * y

    law = sinusoidal_ridges(0.7 * FILM, 0.6)
    line = solve(pad(law, thickness=plane, wide=True), (64, 1)).state.pressure[:, 0]
    wide = solve(pad(law, thickness=plane, width=8 * LENGTH), (64, 128)).state.pressure[:, 64]
    assert wide == pytest.approx(line, rel=1e-3, abs=1e-3 * line.max())


def test_ridges_turned_the_other_way_are_the_film_in_a_mirror():
    def plane(x, y):
        return FILM * (2 - x / LENGTH) + 0 * y

    one, other = (
        solve(pad(sinusoidal_ridges(0.7 * FILM, angle), thickness=plane), (32, 32)).state.pressure
        for angle in (0.6, -0.6)
    )
    assert other == pytest.approx(one[:, ::-1], rel=1e-7, abs=1e-7 * one.max())
    assert np.abs(one - one[:, ::-1]).max() > 0.05 * one.max()


def test_sliding_backwards_over_slanting_ridges_is_the_mirrored_film():
    law = sinusoidal_ridges(0.7 * FILM, 0.6)
    back = solve(pad(law, thickness=lambda x, y: film(LENGTH - x, y), speed=-1.0), (32, 32))
    forth = solve(pad(sinusoidal_ridges(0.7 * FILM, -0.6)), (32, 32))
    assert back.turned
    assert back.state.pressure == pytest.approx(forth.state.pressure, rel=1e-9, abs=1e-9 * forth.state.pressure.max())


def widening(x, y):
    return FILM * (1 + 4 * (x / LENGTH - 0.4) ** 2 + 0.3 * y / WIDTH)


@pytest.mark.parametrize("theta", [0.6, None])
@pytest.mark.parametrize("angle", [0.5, -1.0])
def test_mass_is_kept_where_a_film_with_slanting_ridges_ruptures(theta, angle):
    ends = Ends(inlet=None if theta else 1e5, theta=theta or 1.0, sides=(0.0, 1e5))
    law = sinusoidal_ridges(0.8 * FILM, angle)
    problem = pad(law, thickness=widening, ends=ends, compressibility=ConstantBulkModulus(law="constant_bulk_modulus", bulk_modulus="1 GPa"))  # fmt: skip  # noqa: E501
    found = solve(problem, (64, 64))
    assert 0.1 < (found.kind == CAVITY).mean() < 0.9
    through, flows = flow_along(found)[:, 1:-1].sum(axis=1), boundary_flows(found)
    assert flows.inlet - flows.outlet == pytest.approx(flows.low + flows.high, abs=1e-9 * flows.inlet)
    assert flows.inlet > through[0]
    assert found.state.fill.min() > 0


def test_a_film_joined_across_is_refused():
    problem = pad(sinusoidal_ridges(0.5 * FILM, 0.5), thickness=lambda x, y: film(x, 0 * y))
    shape = replace(problem.shape, joined=(False, True))
    with pytest.raises(InputError, match="periodic across the sliding"):
        solve(replace(problem, shape=shape, ends=replace(problem.ends, sides=None)), (16, 16))
