"""The first estimate of a film under a load: a load far from all that is carried is refused on the first grid."""

import pytest

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.rom.bearing.equilibrium import estimate
from roughfilm.rom.bearing.equilibrium.balance import FilmsAtSpeed, robustly_balanced
from roughfilm.rom.bearing.equilibrium.expected import expected_film
from roughfilm.rom.cavitation.solve import solve
from roughfilm.rom.ladder.scene import read_scene

WEDGE = {"shape": "linear", "length": "20 mm", "width": "20 mm", "rise": "10 um"}
FED = {"shape": "parallel", "length": "20 mm", "width": "20 mm"}
HIGH = {"inlet": {"pressure": "2 MPa"}, "outlet": {"pressure": "2 MPa"}}


def pad(geometry, load, speed="1 m/s", **tables):
    entries = {"name": "pad", "kind": "bearing", "geometry": geometry, "lubricant": {"viscosity": "20 mPa*s"}}
    return read_scene(entries | {"motion": {"speed": speed}, "load": {"pressure": load}} | tables)


@pytest.fixture
def grids(monkeypatch):
    """The grids on which films are sought."""
    made, own = [], estimate.ModelFilms

    def films(**options):
        made.append(options["cells"])
        return own(**options)

    monkeypatch.setattr(estimate, "ModelFilms", films)
    return made


@pytest.mark.parametrize(
    "scene",
    [
        pad(WEDGE, "0.1 MPa", speed="-1 m/s"),
        pad(FED, "1 kPa", boundary=HIGH | {"sides": {"low": "2 MPa", "high": "2 MPa"}}),
    ],
    ids=["widening", "too small"],
)
def test_a_load_that_is_clearly_not_carried_is_refused_once_and_on_one_grid(grids, scene):
    for _ in range(2):
        with pytest.raises(InputError, match="load: got"):
            expected_film(scene)
    assert grids == [estimate.CELLS[False][0]]


def test_the_largest_load_is_named_with_the_finer_grid_that_has_it():
    """A film of a ten-thousandth of the rise ends in a layer that coarse grids do not resolve: fine ones carry more."""
    scene = pad(WEDGE | {"rise": "100 um"}, "1 TPa")
    with pytest.raises(InputError, match="carry at most") as caught:
        expected_film(scene)
    words = str(caught.value)
    named, place = (float(words.split(before)[1].split()[0]) for before in ("at most ", "thickness of "))
    coarse, fine = estimate.CELLS[False]
    assert f"Pa on {fine} cells along a side" in words
    films = [solve(scene.at_film(place).problem(), (cells, cells)) for cells in (coarse, fine, 2 * fine)]
    loads = [float((film.grid.areas * film.state.pressure).sum()) / scene.nominal_area for film in films]
    assert named == pytest.approx(loads[1], rel=1e-3)
    assert loads[0] < 0.7 * named
    assert named < loads[2]


def test_a_load_near_the_largest_is_sought_on_the_finer_grid_too(grids):
    """A parallel film between pressures carries at most these, whatever the grid; 1 % more is refused on both."""
    with pytest.raises(InputError, match="load: got"):
        expected_film(pad(FED, "2.02 MPa", boundary=HIGH | {"sides": {"low": "2 MPa", "high": "2 MPa"}}))
    assert grids == list(estimate.CELLS[False])


class Unsolved:
    """A bearing of which no film is solved: the first is refused, others do not converge."""

    area = widest = touching = 1.0
    closest = 0.5
    remedy = ""

    def __init__(self):
        self.error = InputError("factors: unknown")

    def at(self, _separation, _speed, _start):
        error, self.error = self.error, ConvergenceError("film: does not converge")
        raise error

    def contact_load(self, _separation):
        return 0.0


def test_a_search_without_any_solved_film_ends_with_the_reason(monkeypatch):
    with pytest.raises(InputError, match="factors: unknown"):
        robustly_balanced(FilmsAtSpeed(film=Unsolved(), speed=1.0), 1.0, tolerance=1e-6)

    def refused(*_arguments, **_options):
        raise InputError("factors: unknown")

    monkeypatch.setattr(estimate, "robustly_balanced", refused)
    with pytest.raises(InputError, match="factors: unknown"):
        expected_film(pad(WEDGE, "0.1 MPa"))
