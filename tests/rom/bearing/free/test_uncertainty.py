"""The uncertainty of films whose walls move freely, against finer grids of other shapes."""

import math
from itertools import pairwise

import pytest

from roughfilm.ladder import find
from roughfilm.rom.bearing.free.solve import sizes, solve_free
from roughfilm.rom.cavitation.balance import CAVITY
from roughfilm.rom.cavitation.evaluation.fronts import fraction_at_fronts, hidden_cavities
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

CELLS, FINER = 32, 72


def solved(scene, cells):
    return find("bearing", "reynolds_cavitating").solve(scene, Request(resolution=cells))


def scene(geometry, load, **tables):
    return read_scene(
        {
            "name": "bearing",
            "kind": "bearing",
            "geometry": geometry,
            "lubricant": {"viscosity": "20 mPa*s"},
            "motion": {"speed": "10 m/s"},
            "load": load,
            **tables,
        }
    )


def misaligned():
    """A misaligned full bore with a given flow through a groove."""
    geometry = {
        "shape": "lobes",
        "radius": "50 mm",
        "clearance": "60 um",
        "width": "60 mm",
        "misalignment": ["0.2 mrad", "-0.1 mrad"],
    }
    groove = {"kind": "groove", "angle": "80 deg", "length": "12 mm", "extent": "40 mm", "flow": "1.2 l/min"}
    return scene(geometry, {"force": "6 kN"}, supply=[groove])


def crowned():
    """A crowned pad whose film grows thicker before its outlet at the cavitation pressure."""
    geometry = {"shape": "pivoted", "length": "40 mm", "width": "40 mm", "pivot": 0.58, "crown": "30 um"}
    return scene(geometry, {"pressure": "0.5 MPa"})


@pytest.mark.parametrize("cells", [24, 32, 48, 64, 128, 256])
def test_there_are_three_grids_or_more_that_share_few_nodes(cells):
    along = [size for size, _ in sizes(cells)]
    assert along[-1] == cells
    assert 3 <= len(along) <= 4
    assert all(0.5 < coarse / fine < 0.75 for coarse, fine in pairwise(along))


@pytest.mark.parametrize("name", ["misaligned", "crowned"])
def test_numbers_are_within_their_uncertainty_of_a_finer_grid(name):
    bearing = {"misaligned": misaligned, "crowned": crowned}[name]()
    coarse, fine = solved(bearing, CELLS), solved(bearing, FINER)
    assert len(coarse.quantities) > 20
    for key, one in coarse.quantities.items():
        assert abs(one.value - fine[key].value) <= one.uncertainty + fine[key].uncertainty / 2 + 1e-9 * abs(
            one.value
        ), key


def test_a_grid_may_hide_a_cavity_before_an_outlet_where_the_film_grows_thicker():
    """Without a crown the film narrows all along, so that it cannot rupture."""
    flat = scene({"shape": "pivoted", "length": "40 mm", "width": "40 mm", "pivot": 0.58}, {"pressure": "0.5 MPa"})
    crowned_film, flat_film = (solve_free(one, 12, tolerance=1e-10).solutions[0] for one in (crowned(), flat))
    assert (hidden_cavities(crowned_film)[-2, 1:-1] > 0).all()
    assert not hidden_cavities(flat_film).any()
    result = solved(flat, 12)
    assert result["theta_min"].uncertainty < 1e-9
    assert result["rupture"].uncertainty < 1e-9
    assert result["cavitated_fraction"].uncertainty == 0


def test_the_direction_of_a_shaft_is_no_better_known_than_its_place():
    """The grids may agree in one component of the place by chance."""
    bearing = misaligned()
    result, free = solved(bearing, 24), solve_free(bearing, 24, tolerance=1e-10)
    fine, coarse = (instant.place[:2] for instant in free.instants[:2])
    least = math.degrees(math.dist(fine, coarse) / math.hypot(*fine))
    assert result["attitude_angle"].uncertainty >= least * (1 - 1e-6)


def test_cells_at_fronts_bound_the_cavitated_fraction():
    free = solve_free(misaligned(), 24, tolerance=1e-10)
    solution = free.solutions[0]
    at_fronts = fraction_at_fronts(solution)
    cavity = solution.kind == CAVITY
    assert 0 < at_fronts < solution.grid.areas[cavity].sum() / solution.grid.areas.sum()
