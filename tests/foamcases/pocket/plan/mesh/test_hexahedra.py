"""Volumes, centroids and folds of hexahedra."""

import numpy as np
import pytest

from roughfilm.foamcases.pocket.plan.mesh.hexahedra import cells, quads, upright


def block(nx=4, ny=3, nz=5):
    axes = (np.linspace(0, side, n + 1) ** 1.5 for side, n in ((2.0, nx), (1.0, ny), (3.0, nz)))
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)


def test_cells_of_an_affine_image_have_exact_volumes_and_centroids():
    vertices = block()
    lean = np.array([[1.0, 0.2, 0.5], [-0.3, 1.1, 0.0], [0.1, 0.4, 0.9]])
    volume, centre = cells(vertices @ lean.T)
    middle = sum(vertices[a : a + 4, b : b + 3, c : c + 5] for a in (0, 1) for b in (0, 1) for c in (0, 1)) / 8
    sides = [np.diff(vertices, axis=axis)[..., axis] for axis in range(3)]
    box = sides[0][:, :-1, :-1] * sides[1][:-1, :, :-1] * sides[2][:-1, :-1]
    assert volume == pytest.approx(box * np.linalg.det(lean))
    assert centre == pytest.approx(middle @ lean.T)


def test_cells_fill_a_block_whose_inner_vertices_are_moved_anyhow():
    vertices = block()
    vertices[1:-1, 1:-1, 1:-1] += np.random.default_rng(3).uniform(-0.05, 0.05, (3, 2, 4, 3))
    volume, centre = cells(vertices)
    whole = np.prod([2.0, 1.0, 3.0]) ** 1.5
    assert volume.sum() == pytest.approx(whole)
    moment = (volume[..., None] * centre).sum(axis=(0, 1, 2)) / whole
    assert moment == pytest.approx(np.array([2.0, 1.0, 3.0]) ** 1.5 / 2, abs=5e-3)
    assert upright(vertices).all()


@pytest.mark.parametrize("axis", range(3))
def test_faces_point_along_their_axis(axis):
    area, centre = quads(block(), axis)
    assert (area[..., axis] > 0).all()
    assert np.delete(area, axis, axis=-1) == pytest.approx(0)
    assert centre[..., axis] == pytest.approx(
        np.moveaxis(block(), axis, 0)[:, 0, 0, axis].reshape([-1 if one == axis else 1 for one in range(3)])
        + 0 * centre[..., axis]
    )


def test_a_folded_cell_is_found():
    vertices = block()
    vertices[2, 1, 2, 0] = vertices[3, 1, 2, 0] + 0.1
    folded = ~upright(vertices)
    assert folded[2, 1, 2]
    assert not folded[0].any()
