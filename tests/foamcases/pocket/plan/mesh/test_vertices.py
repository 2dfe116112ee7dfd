"""The mesh of a cell in plan: it follows an exact conformal map, keeps its walls and symmetry, and never folds."""

import numpy as np
import pytest

from roughfilm.foamcases.pocket.plan.mesh.columns import sides_of
from roughfilm.foamcases.pocket.plan.mesh.hexahedra import cells, quads, upright
from roughfilm.foamcases.pocket.plan.mesh.vertices import vertices_of
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.rom.pocket.plan.plan import Plan


def plan_of(*dimples, breadth="0.5 mm", **geometry):
    scene = read_scene(
        {
            "name": "cell",
            "kind": "pocket",
            "geometry": {"length": "0.6 mm", "breadth": breadth, "film": "30 um", "dimples": [*dimples], **geometry},
            "lubricant": {"viscosity": "0.01 Pa*s", "density": "1000 kg/m^3"},
            "motion": {"reynolds_number": 1.0},
        }
    )
    return scene.plan()


def box(edge, **more):
    return {"shape": "box", "width": "0.2 mm", "breadth": "0.25 mm", "depth": "30 um", "edge": edge, **more}


CAP = {"shape": "spherical", "width": "0.3 mm", "depth": "15 um"}
SHAPES = {
    "cap": (CAP,),
    "cone": ({"shape": "conical", "width": "0.2 mm", "depth": "60 um"},),
    "half a sphere": ({"shape": "spherical", "width": "0.2 mm", "depth": "0.1 mm"},),
    "groove": ({"shape": "groove", "width": "0.2 mm", "depth": "60 um"},),
    "box": (box("0.3 um"),),
    "turned box": (box("0.3 um", rotation="30 deg", position="0.05 mm", position_across="-0.1 mm"),),
    "chevron": ({**box("3 um"), "shape": "chevron", "width": "0.1 mm", "angle": "30 deg"},),
    "several": (CAP, {**CAP, "position": "0.3 mm", "position_across": "0.25 mm"}),
}


class Mapped:
    """The gap onto which z = ζ + a sin k(ζ - iH) maps the rectangle 0 <= Im ζ <= H; its upper wall stays straight."""

    length, height, a = 4.0, 0.6, 0.12
    k = 2 * np.pi / length

    def z(self, zeta):
        return zeta + self.a * np.sin(self.k * (zeta - 1j * self.height))

    def coordinate(self, z):
        found = z.copy()
        for _ in range(60):
            found -= (self.z(found) - z) / (1 + self.a * self.k * np.cos(self.k * (found - 1j * self.height)))
        return found.real

    def plan(self, *, turned):
        wall = self.z(np.linspace(-self.length, self.length, 40001) + 0j)

        def thickness(x, y):
            along = (y if turned else x) + 0.0
            inside = along - self.length * np.round(along / self.length)
            return self.height - np.interp(inside, wall.real, wall.imag) + 0 * (x + y)

        return Plan(
            length=self.length,
            breadth=self.length,
            film=1.0,
            thickness=thickness,
            breaks_x=(),
            breaks_y=(),
            mirrored=True,
            smallest=1.0,
        )


@pytest.mark.parametrize("turned", [False, True])
def test_columns_are_those_of_an_exact_conformal_map(turned):
    exact = Mapped()
    errors = []
    for resolution in (16, 48):
        vertices = vertices_of(exact.plan(turned=turned), resolution)
        along, other = vertices[..., int(turned)], vertices[..., int(not turned)]
        mapped = exact.coordinate(along + 1j * (vertices[..., 2] - 1 + exact.height))
        errors.append(np.ptp(mapped, axis=2).max())
        assert np.ptp(other, axis=2).max() < 1e-9
        vertical = exact.coordinate(along[:, :, -1:] + 1j * (vertices[..., 2] - 1 + exact.height))
        assert np.ptp(vertical, axis=2).max() > 15 * errors[-1]
    assert errors[0] > 4 * errors[1]


@pytest.mark.parametrize("name", SHAPES)
def test_cells_fill_the_gap_and_do_not_fold(name):
    plan = plan_of(*SHAPES[name])
    vertices = vertices_of(plan, 30)
    lower, upper = vertices[:, :, 0], vertices[:, :, -1]
    sides = sides_of(plan, 30)
    assert upright(vertices).all()
    assert lower[..., 2] == pytest.approx(
        1 - plan.thickness(lower[..., 0] * plan.film, lower[..., 1] * plan.film) / plan.film, abs=1e-9
    )
    assert (upper[..., 2] == 1).all()
    assert (upper[..., 0] == sides.x[:, None]).all()
    assert (upper[..., 1] == sides.y).all()
    length, breadth = plan.length / plan.film, plan.breadth / plan.film
    assert vertices[-1, :, :, :2] - vertices[0, :, :, :2] == pytest.approx(
        np.broadcast_to([length, 0], vertices[0, :, :, :2].shape), abs=1e-12
    )
    assert vertices[:, -1] - vertices[:, 0] == pytest.approx(
        np.broadcast_to([0, breadth, 0], vertices[:, 0].shape), abs=1e-9
    )
    places = (np.arange(500) + 0.5) / 500 - 0.5
    mean = plan.thickness(places[:, None] * plan.length, places * plan.breadth).mean() / plan.film
    assert cells(vertices)[0].sum() == pytest.approx(mean * length * breadth, rel=1e-2)


@pytest.mark.parametrize("name", ["cap", "box", "chevron"])
def test_a_mirrored_cell_has_a_mirrored_mesh(name):
    plan = plan_of(*SHAPES[name])
    assert plan.mirrored
    vertices = vertices_of(plan, 31)
    mirrored = vertices[:, ::-1] * [1, -1, 1]
    assert vertices == pytest.approx(mirrored, abs=1e-12)
    middle = vertices.shape[1] // 2
    assert (vertices[:, middle, :, 1] == 0).all()
    assert np.ptp(vertices[:, -1, :, 1]) == 0


def test_columns_meet_a_steep_wall_nearly_at_right_angles():
    plan = plan_of({"shape": "spherical", "width": "0.15 mm", "depth": "20 um", "edge": "0.03 mm"})
    lines, vertical = [], []
    for resolution in (40, 80):
        vertices = vertices_of(plan, resolution)
        area, _ = quads(vertices[:, :, :2], 2)
        normal = area[:, :, 0] / np.linalg.norm(area[:, :, 0], axis=-1, keepdims=True)
        line = cells(vertices[:, :, :2])[1][:, :, 0] - quads(vertices[:, :, :2], 2)[1][:, :, 0]
        line /= np.linalg.norm(line, axis=-1, keepdims=True)
        lines.append(np.degrees(np.arccos(np.clip((normal * line).sum(axis=-1), -1, 1))).max())
        vertical.append(np.degrees(np.arccos(normal[..., 2])).max())
    assert min(vertical) > 20
    assert lines[1] < 5


def test_columns_are_denser_over_dimples_and_at_their_outlines():
    plan = plan_of(CAP)
    sides = sides_of(plan, 60)
    assert (sides.x.size, sides.y.size) == (61, 51)
    assert (sides.x[[0, -1]] * plan.film) == pytest.approx([-plan.length / 2, plan.length / 2])
    steps = np.diff(sides.x)
    outline = np.abs((sides.x[1:] + sides.x[:-1]) / 2 - 5).argmin()
    assert steps[0] > 2 * steps[np.abs(sides.x[1:] - 2.5).argmin()] > 2 * steps[outline]
