"""Meshes of a gap hold its volume, close around it, and face into the liquid; other readers find the same."""

from collections import Counter

import meshio
import numpy as np
import pytest
import pyvista
from places import SCENES

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.meshes.files import write_mesh
from roughfilm.contact.meshes.mesh import CellType, Mesh, boundary, grid, in_triangles
from roughfilm.contact.meshes.surface import surface_mesh
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.foamcases.openfoam.program import succeed
from roughfilm.ladder import find
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Field, Numerics, Result
from roughfilm.rom.ladder.scene import load_scene
from roughfilm.rom.meshes.result_mesh import result_mesh
from roughfilm.rom.meshes.walls_mesh import GapPart, gap_mesh, wall_mesh
from roughfilm.rom.rough_gap.walls import Walls

MEAN, AMPLITUDE = 1e-5, 3e-6
NUMERICS = Numerics(
    residual=0, iterations=1, cpu_s=0, wall_s=0, degrees_of_freedom=1, resolution=1, tolerance=1, scheme=""
)


@pytest.fixture
def walls():
    """A product of waves under a tilted one, 50 x 30 µm; the mean gap is exact on any nodes."""
    x, y = np.meshgrid(np.arange(12) / 12, np.arange(9) / 9, indexing="ij")
    lower = AMPLITUDE * np.cos(2 * np.pi * x) * np.cos(2 * np.pi * y)
    upper = MEAN + AMPLITUDE * np.sin(2 * np.pi * (x + y))
    return Walls(lower=lower, upper=upper, spacing=(50e-6 / 12, 30e-6 / 9))


@pytest.fixture
def touching(walls):
    """Contact in a patch, along a diagonal line, and at a lone point."""
    lower = walls.lower.copy()
    for place in [(slice(2, 5), slice(3, 6)), (8, 1), (9, 2), (10, 7)]:
        lower[place] = walls.upper[place]
    return Walls(lower=lower, upper=walls.upper, spacing=walls.spacing)


def volume_inside(mesh: Mesh) -> float:
    """By the divergence theorem, positive if the normals point outward."""
    a, b, c = np.moveaxis(mesh.points[mesh.cells], 1, 0)
    return np.einsum("ni,ni", a, np.cross(b, c)) / 6


def directed_edges(cells) -> Counter:
    return Counter((int(a), int(b)) for cell in cells for a, b in zip(cell, np.roll(cell, -1), strict=True))


def test_hexahedra_hold_the_volume_of_the_gap(walls, touching):
    for given, volume in ((walls, 50e-6 * 30e-6 * MEAN), (touching, touching.gap.sum() * np.prod(touching.spacing))):
        mesh = gap_mesh(given, 5)
        assert mesh.content == pytest.approx(volume, rel=1e-12)
        assert volume_inside(boundary(mesh)) == pytest.approx(volume, rel=1e-12)
    assert len(gap_mesh(walls, 5).cells) == 12 * 9 * 5
    assert len(gap_mesh(touching, 5).cells) == (12 * 9 - 4) * 5


def test_the_boundary_of_a_gap_is_closed(walls, touching):
    edges = directed_edges(boundary(gap_mesh(walls, 3)).cells)
    assert set(edges.values()) == {1}
    assert all((b, a) in edges for a, b in edges)
    edges = directed_edges(boundary(gap_mesh(touching, 3)).cells)
    assert all(edges[b, a] == times for (a, b), times in edges.items())


def test_walls_face_the_liquid_and_lie_where_they_are(walls):
    for part, sign, heights in ((GapPart.LOWER, 1, walls.lower), (GapPart.UPPER, -1, walls.upper)):
        mesh = wall_mesh(walls, part)
        a, b, c = np.moveaxis(mesh.points[in_triangles(mesh).cells], 1, 0)
        assert np.all(sign * np.cross(b - a, c - a)[:, 2] > 0)
        nearest = mesh.points[np.abs(mesh.points[:, :2] - [3 * 50e-6 / 12, 4 * 30e-6 / 9]).sum(axis=1).argmin()]
        assert nearest[2] == heights[3, 4]
        last = mesh.points[np.isclose(mesh.points[:, 0], 50e-6) & np.isclose(mesh.points[:, 1], 30e-6)]
        assert last[0, 2] == heights[0, 0]


@pytest.mark.parametrize("suffix", [".vtu", ".msh"])
def test_volumes_read_back_are_the_same(touching, tmp_path, suffix):
    mesh = gap_mesh(touching, 4)
    write_mesh(mesh, tmp_path / f"gap{suffix}")
    volume = touching.gap.sum() * np.prod(touching.spacing)
    found = meshio.read(tmp_path / f"gap{suffix}")
    read = Mesh(points=found.points, cell_type=CellType.HEXAHEDRON, cells=found.cells_dict["hexahedron"])
    assert volume_inside(boundary(read)) == pytest.approx(volume, rel=1e-10)
    assert np.array_equal(np.ravel(found.point_data["gap (m)"]), mesh.point_data["gap (m)"])
    seen = pyvista.read(tmp_path / f"gap{suffix}") if suffix == ".vtu" else pyvista.from_meshio(found)
    assert seen.volume == pytest.approx(volume, rel=1e-6)
    assert seen.bounds[1] == pytest.approx(50e-6, rel=1e-12)


def test_an_stl_of_the_gap_is_closed_and_outward(walls, tmp_path):
    written = write_mesh(gap_mesh(walls, 2), tmp_path / "gap.stl")
    assert written.cell_type is CellType.TRIANGLE
    seen = pyvista.read(tmp_path / "gap.stl")
    assert seen.is_manifold
    assert seen.n_open_edges == 0
    assert seen.volume == pytest.approx(50e-6 * 30e-6 * MEAN, rel=1e-5)
    found = meshio.read(tmp_path / "gap.stl")
    read = Mesh(points=found.points, cell_type=CellType.TRIANGLE, cells=found.cells_dict["triangle"])
    assert volume_inside(read) == pytest.approx(50e-6 * 30e-6 * MEAN, rel=1e-5)


@pytest.mark.openfoam
def test_openfoam_reads_the_gmsh_file(walls, tmp_path):
    write_mesh(gap_mesh(walls, 4), tmp_path / "gap.msh")
    (tmp_path / "system").mkdir()
    for name, entries in (
        ("controlDict", "deltaT 1; endTime 1; writeInterval 1;"),
        ("fvSchemes", "divSchemes {} gradSchemes {} laplacianSchemes {}"),
        ("fvSolution", ""),
    ):
        head = f"FoamFile {{ version 2.0; format ascii; class dictionary; object {name}; }}"
        (tmp_path / "system" / name).write_text(f"{head}\n{entries}\n")
    succeed(tmp_path, ["gmshToFoam", "gap.msh"], "log.gmshToFoam")
    stated = succeed(tmp_path, ["checkMesh"], "log.checkMesh").log
    assert f"Total volume = {50e-6 * 30e-6 * MEAN:.2g}" in stated
    assert "Mesh OK" in stated


def test_a_file_that_cannot_be_written_is_stated(walls, tmp_path):
    mesh = gap_mesh(walls, 1)
    with pytest.raises(InputError, match=r"suffix '\.obj'"):
        write_mesh(mesh, tmp_path / "gap.obj")
    with pytest.raises(InputError, match="nothing to export"):
        write_mesh(mesh.kept(np.zeros(len(mesh.cells), dtype=bool)), tmp_path / "gap.vtu")
    with pytest.raises(InputError, match="this is a line"):
        write_mesh(grid(np.eye(3)), tmp_path / "line.stl")
    assert not list(tmp_path.iterdir())


def test_a_surface_leaves_out_what_was_not_measured():
    invalid = np.zeros((6, 5), dtype=bool)
    invalid[2, 2] = True
    flat = np.full((6, 5), 2e-6)
    once = surface_mesh(Surface(heights=flat, spacing=(1e-6, 2e-6), invalid=invalid))
    assert once.content == pytest.approx((5 * 4 - 4) * 2e-12)
    assert surface_mesh(Surface(heights=flat, spacing=(1e-6, 2e-6), periodic=True)).content == pytest.approx(60e-12)


def result_of(**fields) -> Result:
    made = {name: Field(values=np.asarray(values), unit=unit) for name, (values, unit) in fields.items()}
    return Result(model="made", quantities={}, fields=made, numerics=NUMERICS, provenance={})


def test_cells_of_a_result_keep_their_values():
    x, y, z = np.meshgrid(np.arange(4.0), np.arange(3.0), np.arange(6.0), indexing="ij")
    middle = np.stack([a[:-1, :-1, :-1] + 0.5 for a in (x, y, z)], axis=-1)
    kept = np.ones((3, 2))
    kept[1, 0] = 0
    pressure = 100 * middle[..., 0] + 10 * middle[..., 1] + middle[..., 2]
    mesh = result_mesh(
        result_of(
            vertices=(np.stack([x, y, z], axis=-1), "m"),
            kept=(kept, "1"),
            cell_velocity=(middle, "m/s"),
            cell_pressure=(pressure, "Pa"),
            gap=(np.ones((3, 2)), "m"),
        )
    )
    centres = mesh.points[mesh.cells].mean(axis=1)
    assert len(mesh.cells) == 5 * 5
    assert not np.any((centres[:, 0] == 1.5) & (centres[:, 1] == 0.5))
    assert np.array_equal(mesh.cell_data["cell_velocity (m/s)"], centres)
    assert mesh.cell_data["cell_pressure (Pa)"] == pytest.approx(centres @ [100, 10, 1])
    assert set(mesh.cell_data) == {"cell_velocity (m/s)", "cell_pressure (Pa)"}


def test_a_sector_has_the_area_of_a_ring():
    angle, radius = np.meshgrid(np.linspace(0, np.pi / 2, 201), np.linspace(1.0, 3.0, 5), indexing="ij")
    mesh = result_mesh(result_of(x=(angle, "rad"), y=(radius, "m"), pressure=(radius, "Pa")))
    assert mesh.content == pytest.approx(np.pi / 4 * (9 - 1), rel=1e-4)
    assert mesh.point_data["pressure (Pa)"] == pytest.approx(np.linalg.norm(mesh.points, axis=1))


def test_a_result_without_places_is_refused():
    with pytest.raises(InputError, match=r"none of its fields \(pressure\) has positions in a plane"):
        result_mesh(result_of(pressure=(np.ones((3, 3)), "Pa")))


def test_a_cell_in_plan_is_covered_by_the_columns_of_its_result():
    scene = load_scene(SCENES / "dimple.toml", ["geometry.breadth=0.5 mm"])
    mesh = result_mesh(find("pocket", "reynolds").solve(scene, Request(resolution=16)))
    assert mesh.content == pytest.approx(1e-3 * 0.5e-3)
    assert {"film_thickness (m)", "pressure (Pa)", "shear_stress (Pa)"} <= set(mesh.cell_data)
    centres = mesh.points[mesh.cells].mean(axis=1)
    gap = scene.plan().thickness(centres[:, 0], centres[:, 1])
    assert mesh.cell_data["film_thickness (m)"] == pytest.approx(gap)
