"""The mesh of a pad follows its wall, has vertical sides at steps, and is refused where cells would be bad."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.foamcases.bearing.mesh import default_columns, plane_of, step_obstacle
from roughfilm.foamcases.conformal.cells import centres, convex, corners
from roughfilm.rom.bearing.wide_pad.gap import pad_gap

LENGTH, FILM = 1e-3, 3e-5


BOXES = {"profile": "box", "length": "0.2 mm", "depth": "20 um", "start": "0.1 mm", "pitch": "0.3 mm", "columns": 2}
STEPPED = [
    {"shape": "step", "rise": "30 um", "step": "0.6 mm"},
    {"texture": BOXES},
    {"shape": "linear", "rise": "15 um", "texture": BOXES},
    {"shape": "step", "rise": "30 um", "step": "0.6 mm", "texture": {**BOXES, "start": "0.05 mm"}},
    {"shape": "step", "rise": "30 um", "step": "0.5 mm", "texture": {**BOXES, "profile": "cylindrical", "columns": 1}},
    {"shape": "squared_cosine_inlet", "amplitude": "10 um", "wavelength": "0.25 mm", "extent": "0.5 mm"},
]


@pytest.mark.parametrize("speed", ["1 m/s", "-1 m/s"])
@pytest.mark.parametrize("geometry", STEPPED)
def test_cells_of_a_wall_with_steps_fill_the_film_and_no_more(pad, geometry, speed):
    scene = pad(speed, **geometry)
    assert step_obstacle(scene) is None
    mesh, gap = plane_of(scene, 60), pad_gap(scene)
    assert convex(mesh.vertices)[mesh.kept].all()
    a, b, c, d = corners(mesh.vertices)
    one, other = c - a, d - b
    area = ((one[..., 0] * other[..., 1] - one[..., 1] * other[..., 0]) / 2)[mesh.kept].sum()
    x = np.linspace(0, LENGTH, 200_001)
    assert area * FILM**2 == pytest.approx(np.trapezoid(gap.thickness(x), x), rel=1e-3)
    middle = centres(mesh.vertices)
    depth = (1 - middle[..., 1]) * FILM
    thickness = gap.thickness(middle[..., 0] * FILM)
    assert (depth[mesh.kept] < thickness[mesh.kept]).all()
    assert (depth[~mesh.kept] > thickness[~mesh.kept]).all()


def test_a_wall_without_steps_keeps_all_cells(pad):
    mesh = plane_of(pad(shape="linear", rise="15 um"), 60)
    assert mesh.kept.all()
    assert mesh.vertices[0, 0] == pytest.approx([0.0, -0.5])
    assert mesh.vertices[-1, -1] == pytest.approx([LENGTH / FILM, 1.0])


def test_the_default_resolves_every_pocket(pad):
    columns = {"profile": "cylindrical", "length": "20 um", "depth": "5 um", "pitch": "25 um", "columns": 40}
    assert default_columns(pad()) == 240
    assert default_columns(pad(texture=columns)) == 50 * 24


def test_steps_beside_steep_walls_and_above_most_of_the_film_are_refused(pad):
    steep = pad(
        shape="step", rise="30 um", step="0.5 mm", texture={**BOXES, "profile": "cylindrical", "length": "40 um"}
    )
    assert "the wall has steps and slopes of up to" in step_obstacle(steep)
    wave = {"amplitude": "29 um", "wavelength": "0.5 mm", "extent": "0.125 mm"}
    assert "a step of more than 90%" in step_obstacle(pad(shape="sinusoidal_inlet", **wave))


def test_a_cell_over_several_steps_is_refused(pad):
    narrow = {"profile": "box", "length": "1 um", "depth": "1 um", "start": "0.1 mm", "pitch": "5 um", "columns": 100}
    with pytest.raises(InputError, match="resolution: got 20, by which a cell lies over several steps"):
        plane_of(pad(texture=narrow), 20)
