"""Solids of any shape in a flow: what is cut out, closed forms for planes and spheres, and how it fails."""

import math
import tempfile
from pathlib import Path

import numpy as np
import pytest
import pyvista

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.meshes.mesh import CellType, Mesh
from roughfilm.foamcases.openfoam.block_mesh import Patch
from roughfilm.foamcases.openfoam.residuals import Judged
from roughfilm.foamcases.rough_gap.dictionaries import DRIVES, SIDES
from roughfilm.foamcases.snappy.snapped import run_snapped, write_snapped
from roughfilm.foamcases.snappy.solid import Box, Carved, carved, repeated
from roughfilm.rom.rough_gap.walls import Walls

UM = 1e-6
CONCENTRATION = 0.125
RADIUS = (3 * CONCENTRATION / (4 * math.pi)) ** (1 / 3)
ZICK_HOMSY = 4.292
"""Drag over 6πηaU of a simple cubic array of spheres at that concentration: doi:10.1017/S0022112082000627, Table 2."""

MIRRORS = (*SIDES[:4], *(Patch(name=name, entries={"type": "symmetryPlane"}) for name in ("below", "above")))


def ball(radius: float, middle: float) -> Mesh:
    found = pyvista.Icosphere(radius=radius, center=(middle,) * 3, nsub=4)
    return Mesh(
        points=np.array(found.points, float), cell_type=CellType.TRIANGLE, cells=found.faces.reshape(-1, 4)[:, 1:]
    )


def flow_through(given: Carved, *judged: Judged, **options):
    with tempfile.TemporaryDirectory() as place:
        case = Path(place) / "case"
        write_snapped(given, case, drive=DRIVES[0], reynolds_number=1e-3, **options)
        return run_snapped(case, *judged)


@pytest.mark.openfoam
def test_a_plane_between_the_faces_of_the_block_leaves_a_smooth_gap():
    h = 0.93
    lower = np.zeros((4, 3))
    walls = Walls(lower=lower, upper=lower + h * UM, spacing=(0.15 * UM, 0.2 * UM))
    found = flow_through(carved(walls, UM, 8), Judged(fields=("Ux",)))
    assert found.volume == pytest.approx(h, rel=1e-6)
    assert 1 < found.flow_per_width[0] / h**3 < 1 + 4 / 8**2
    assert abs(found.flow_per_width[1:]).max() < 1e-6
    assert found.residual <= 2e-5
    assert not found.warnings


@pytest.mark.openfoam
def test_a_lattice_of_spheres_drags_as_it_should():
    """12 = 6πaUK in units of the side; of second order, so that two meshes tell the limit."""
    drag = []
    for cells in (8, 12):
        box = Box(size=(1.0, 1.0), bottom=0.0, top=1.0, cells=(cells,) * 3)
        given = Carved(box=box, solid=ball(RADIUS, 0.5), inside=(0.01, 0.013, 0.017))
        found = flow_through(given, level=1, sides=MIRRORS)
        assert found.volume == pytest.approx(1 - CONCENTRATION, rel=5e-3)
        drag.append(2 / (math.pi * RADIUS * found.flow_per_width[0]))
    assert drag[1] == pytest.approx(ZICK_HOMSY, rel=0.08)
    assert drag[1] + (drag[1] - drag[0]) / (1.5**2 - 1) == pytest.approx(ZICK_HOMSY, rel=0.015)


@pytest.mark.openfoam
def test_a_place_inside_the_solid_is_stated():
    box = Box(size=(1.0, 1.0), bottom=0.0, top=1.0, cells=(8, 8, 8))
    given = Carved(box=box, solid=ball(0.4, 0.5), inside=(0.51, 0.52, 0.53))
    with pytest.raises(ConvergenceError, match="does not reach the side 'west'"):
        flow_through(given)


def test_a_solid_goes_on_beyond_its_period():
    lone = ball(0.2, 0.0)
    whole = repeated(lone, (2.0, 3.0))
    for x in (0.0, 2.0):
        for y in (0.0, 3.0):
            assert (np.linalg.norm(whole.points - [x, y, 0.0], axis=1) < 0.2 * (1 + 1e-6)).sum() == len(lone.points)
    assert len(whole.cells) == 4 * len(lone.cells)
    middle = Mesh(points=lone.points + np.array([1.0, 1.5, 0.0]), cell_type=lone.cell_type, cells=lone.cells)
    assert len(repeated(middle, (2.0, 3.0)).cells) == len(lone.cells)


def test_the_walls_of_a_gap_bound_its_liquid():
    """A line upward through the place in the liquid meets the lower wall below it; contact goes on above the block."""
    rng = np.random.default_rng(3107)
    lower = rng.uniform(-0.4, 0.3, size=(8, 6)) * UM
    lower[2:4, 3] = UM
    flat = Walls(lower=lower, upper=np.full((8, 6), UM), spacing=(0.5 * UM, 0.4 * UM))
    rough = Walls(lower=lower, upper=np.maximum(lower, rng.uniform(0.8, 1.2, (8, 6)) * UM), spacing=flat.spacing)
    for walls, sheets in ((flat, 1), (rough, 2)):
        found = carved(walls, UM, 8)
        assert found.box.size == pytest.approx((4.0, 2.4))
        assert found.box.bottom < -0.4
        surface = pyvista.PolyData.from_regular_faces(found.solid.points, found.solid.cells)
        x, y, z = found.inside
        hits = np.sort(surface.ray_trace((x, y, -9.0), (x, y, 9.0))[0][:, 2])
        assert len(hits) == sheets
        assert hits[0] < z < (found.box.top if sheets == 1 else hits[1])
        top = surface.ray_trace((1.0, 1.2, 9.0), (1.0, 1.2, -9.0), first_point=True)[0]
        assert top[2] >= found.box.top - 1e-9 if sheets == 1 else top[2] > walls.upper[2, 3] / UM


@pytest.mark.parametrize("inside", [(1.5, 0.5, 0.5), (0.5, -0.1, 0.5), (0.5, 0.5, 2.0)])
def test_a_place_outside_the_box_is_refused(inside, tmp_path):
    box = Box(size=(1.0, 1.0), bottom=0.0, top=1.0, cells=(4, 4, 4))
    given = Carved(box=box, solid=ball(0.2, 0.5), inside=inside)
    with pytest.raises(InputError, match="lies outside the box"):
        write_snapped(given, tmp_path / "case", drive=DRIVES[0], reynolds_number=1.0)
    assert not list(tmp_path.iterdir())
