"""OpenFOAM against an independent solver good to 1e-4, exact limits, symmetry and its own order."""

import numpy as np
import pytest

from roughfilm import foamcases, rom
from roughfilm.figures.streamlines import stream_function
from roughfilm.foamcases.conformal.cells import centres
from roughfilm.foamcases.pocket import card
from roughfilm.ladder import find
from roughfilm.rom.ladder.model import ladder, of_kind
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene, scene_entries
from roughfilm.rom.studies.convergence import ConvergenceKind, convergence

pytestmark = pytest.mark.openfoam

MODELS = of_kind(ladder(rom, foamcases), "pocket")
STOKES, NAVIER_STOKES = find("pocket", "stokes"), find("pocket", "navier_stokes")
PLUS = ("load_plus", "friction_plus", "pressure_max_plus", "pressure_min_plus")

REFERENCE = [
    (0.30, 0.25, 160, (3.303, 2.922, 18.33, -5.93)),
    (0.30, 0.75, 160, (4.179, 2.903, 24.76, -7.41)),
    (0.50, 0.25, 40, (1.629, 2.850, 11.77, -8.70)),
]


STEEP = [
    (0.20, 2.00, 40, None, 0.2046),
    (0.15, 1.25, 160, -0.3, 1.0235),
    (0.30, 2.00, 100, None, 0.9664),
]
"""w+, d+, Re, xd+ of splined grooves, and the load by Taylor-Hood finite elements, converged to the digits given."""


def steep_scene(make_scene, width, depth, reynolds_number, shift):
    entries = scene_entries(make_scene(width, depth, reynolds_number))
    if shift is not None:
        entries["geometry"] |= {"profile": "splined", "shift": f"{shift * width} mm"}
    return read_scene(entries)


@pytest.fixture(scope="module")
def solve():
    """Solve a scene by a model at a resolution, once for all tests."""
    known = {}

    def solved(model, scene, resolution=None):
        key = model.name, scene.model_dump_json(), resolution or model.resolution_of(scene)
        if key not in known:
            known[key] = model.solve(scene, Request(resolution=resolution))
        return known[key]

    return solved


def plus(result):
    return np.array([result.quantities[name].value for name in PLUS])


@pytest.mark.parametrize(("width", "depth", "reynolds_number", "expected"), REFERENCE)
def test_navier_stokes_is_within_one_percent(make_scene, solve, width, depth, reynolds_number, expected):
    got = plus(solve(NAVIER_STOKES, make_scene(width, depth, reynolds_number)))
    assert got == pytest.approx(np.array(expected), rel=1e-2)


def test_stokes_is_within_one_percent_antisymmetric_and_carries_no_load(make_scene):
    result = STOKES.solve(make_scene(0.30, 0.25, 160))
    load, friction, highest, lowest = plus(result)
    assert np.array([friction, highest, lowest]) == pytest.approx(np.array([2.917, 6.98, -6.98]), rel=1e-2)
    assert abs(load) < 1e-6 * highest
    pressure = result.fields["pressure"].values
    assert np.abs(pressure + pressure[::-1]).max() < 1e-6 * np.abs(pressure).max()


def test_stokes_does_not_depend_on_the_parity_of_the_grid(make_scene):
    scene = make_scene(0.30, 0.25, 160)
    even, odd = (plus(STOKES.solve(scene, Request(resolution=n))) for n in (80, 81))
    assert even[1:] == pytest.approx(odd[1:], rel=5e-3)
    assert abs(odd[0]) < 1e-6 * odd[2]


def test_a_hardly_grooved_wall_is_smooth(make_scene):
    load, friction, highest, _lowest = plus(NAVIER_STOKES.solve(make_scene(0.3, 1e-4, 160), Request(resolution=60)))
    assert friction == pytest.approx(3.0, abs=1e-3)
    assert max(abs(load), highest) < 0.02


def test_stokes_becomes_reynolds_as_the_slope_vanishes(make_scene):
    """A groove four times as wide cuts the slope effect on pressure; wide and shallow must agree to 1 %."""
    reynolds = find("pocket", "reynolds")
    gaps = []
    for width, depth in ((0.15, 0.5), (0.6, 0.5)):
        scene = make_scene(width, depth, 1)
        thin, thick = plus(reynolds.solve(scene)), plus(STOKES.solve(scene, Request(resolution=120)))
        gaps.append(abs(thick[2] / thin[2] - 1))
    assert gaps[1] < gaps[0] / 3
    assert gaps[1] < 0.01


def test_weighted_inertia_is_nearer_to_navier_stokes_at_small_reynolds_numbers_than_averaged_would_be(make_scene):
    """At Re = 4 the exact first-order load is within the slope effect of Navier-Stokes; 10-15 % less would not be."""
    scene = make_scene(0.5, 0.25, 4)
    film = plus(find("pocket", "inertial_reynolds").solve(scene))[0]
    full = plus(NAVIER_STOKES.solve(scene))[0]
    assert film == pytest.approx(full, rel=0.05)


def test_load_and_friction_converge_at_second_order(make_scene, solve):
    """Load of a flow with inertia, friction of one without (with it, two errors nearly cancel in friction).

    The groove of the second flow is splined: Stokes flow is singular at the corners of an arc, and converges slower.
    """
    cases = [
        (NAVIER_STOKES, make_scene(0.5, 0.25, 40), 0, (60, 120, 240)),
        (STOKES, steep_scene(make_scene, 0.3, 0.75, 1, 0.0), 1, (48, 96, 192)),
    ]
    for model, scene, which, grids in cases:
        coarse, middle, fine = (plus(solve(model, scene, n))[which] for n in grids)
        assert np.log2((middle - coarse) / (fine - middle)) == pytest.approx(2, abs=0.4)


def test_back_flow_begins_with_depth(make_scene, solve):
    shallow = solve(NAVIER_STOKES, make_scene(0.3, 0.25, 160), resolution=120).quantities["backflow"].value
    deep = solve(NAVIER_STOKES, make_scene(0.3, 0.75, 160), resolution=120).quantities["backflow"].value
    assert shallow == 0
    assert deep == pytest.approx(0.021, abs=0.002)


def test_flow_rate_is_the_same_through_every_column(make_scene, solve):
    result = solve(NAVIER_STOKES, make_scene(0.3, 0.75, 160), resolution=120)
    psi = stream_function(result.fields["vertices"].values, result.fields["cell_velocity"].values)
    assert np.ptp(psi[:, -1]) < 5e-3 * psi[:, -1].mean()


def test_the_film_thickness_is_that_of_the_gap_over_the_place_on_the_sliding_wall(make_scene):
    scene = steep_scene(make_scene, *STEEP[1][:4])
    result = STOKES.solve(scene, Request(resolution=30))
    thickness, position, vertices = (result.fields[name].values for name in ("film_thickness", "position", "vertices"))
    assert position == pytest.approx((vertices[1:, -1, 0] + vertices[:-1, -1, 0]) / 2)
    assert thickness == pytest.approx(scene.gap().thickness(position))
    assert thickness.max() > 2 * thickness.min()


def test_walls_drag_each_other_equally(make_scene, solve):
    """Steady and periodic: what the sliding wall loses in friction, the grooved wall takes up as shear and pressure."""
    result = solve(NAVIER_STOKES, make_scene(0.3, 0.75, 160))
    vertices, pressure, velocity = (
        result.fields[name].values for name in ("vertices", "cell_pressure", "cell_velocity")
    )
    viscosity, length = 0.01, 1e-3
    wall, middle = vertices[:, 0], centres(vertices[:, :3])
    sides = np.diff(wall, axis=0)
    tangent = sides / np.linalg.norm(sides, axis=1, keepdims=True)
    normal = np.stack([-tangent[:, 1], tangent[:, 0]], axis=1)
    near, far = ((middle[:, layer] - (wall[1:] + wall[:-1]) / 2) * normal for layer in (0, 1))
    near, far = near.sum(axis=1), far.sum(axis=1)
    shear = viscosity * (velocity[:, 0] * tangent).sum(axis=1) / near
    wall_pressure = (pressure[:, 0] * far - pressure[:, 1] * near) / (far - near)
    drag = (shear * sides[:, 0]).sum() + (wall_pressure * sides[:, 1]).sum()
    assert drag / length == pytest.approx(result.quantities["friction_per_area"].value, rel=2e-3)


@pytest.mark.parametrize(("width", "depth", "reynolds_number", "shift", "load"), STEEP)
def test_the_extrapolated_load_over_steep_grooves_is_that_of_finite_elements(
    make_scene, width, depth, reynolds_number, shift, load
):
    scene = steep_scene(make_scene, width, depth, reynolds_number, shift)
    runs = [NAVIER_STOKES.solve(scene, Request(resolution=n)) for n in (60, 120, 240)]
    study = convergence(NAVIER_STOKES, runs, scene)["load_plus"]
    assert study.value == pytest.approx(load, rel=3e-3)
    assert abs(study.value - load) < study.uncertainty
    assert abs(study.values[-1] - load) < study.uncertainty < 0.05 * load


@pytest.mark.parametrize(
    ("width", "depth", "load", "least", "most"), [(0.30, 0.25, 3.303, 1.7, 2.5), (0.15, 0.50, 1.603, 1.0, 2.0)]
)
def test_load_of_navier_stokes_extrapolates_to_the_independent_value(
    make_scene, solve, width, depth, load, least, most
):
    """Second order over a shallow groove; less over a short steep one, whose edges are sharper."""
    scene = make_scene(width, depth, 160)
    runs = [solve(NAVIER_STOKES, scene, n) for n in (240, 60, 120)]
    found = convergence(NAVIER_STOKES, runs, scene)["load_plus"]
    assert found.grids == (60, 120, 240)
    assert found.kind is ConvergenceKind.MONOTONE
    assert least < found.order < most
    assert abs(found.value - load) < found.uncertainty < 0.01 * load
    assert found.value == pytest.approx(load, rel=1e-3)


@pytest.mark.parametrize(("ratio", "columns"), [(0.1, 120), (0.4, 60)])
def test_grids_of_different_aspect_ratio_agree(make_scene, monkeypatch, ratio, columns):
    """The load of two grids, extrapolated at second order, whatever the number of layers over that of columns.

    The finite elements above are met at the usual ratio, 0.2.
    """
    monkeypatch.setattr(card, "LAYERS_PER_COLUMN", ratio)
    *groove, load = STEEP[0]
    scene = steep_scene(make_scene, *groove)
    coarse, fine = (plus(NAVIER_STOKES.solve(scene, Request(resolution=n)))[0] for n in (columns, 2 * columns))
    assert fine + (fine - coarse) / 3 == pytest.approx(load, rel=0.01)


def test_upwind_is_of_first_order_and_carries_too_much_load(make_scene):
    """4.179 is the load of an independent solver; at 240 columns numerical diffusion adds 5 to 7 % to it."""
    scene = make_scene(0.3, 0.75, 160)
    runs = [NAVIER_STOKES.solve(scene, Request(resolution=n, scheme="upwind")) for n in (60, 120, 240)]
    coarse, middle, fine = (plus(run)[0] for run in runs)
    assert np.log2((coarse - middle) / (middle - fine)) == pytest.approx(1, abs=0.2)
    assert 0.05 < fine / 4.179 - 1 < 0.07
    assert [run.numerics.scheme for run in runs] == ["upwind"] * 3


@pytest.mark.slow
def test_several_processes_find_what_one_finds(make_scene):
    scene = make_scene(0.3, 0.75, 160)
    alone, together = (NAVIER_STOKES.solve(scene, Request(resolution=60, processes=n)) for n in (1, 2))
    assert plus(together) == pytest.approx(plus(alone), rel=1e-6, abs=1e-6)
    shape = alone.fields["cell_velocity"].values.shape
    assert together.fields["cell_velocity"].values.shape == shape
    difference = together.fields["cell_velocity"].values - alone.fields["cell_velocity"].values
    assert np.abs(difference).max() < 1e-6 * scene.speed
    assert together.numerics.processes == 2
    assert together.numerics.cpu_s > 0


def of_reynolds(film, *, length=1e-2, width=3e-3, depth=3e-7, viscosity=0.01, speed=1.0):
    """Friction, Pa, and peak pressure, Pa, of a groove of an arc by the Reynolds equation, by quadrature here."""
    radius = (width**2 / 4 + depth**2) / (2 * depth)
    x = np.linspace(-length / 2, length / 2, 200_001)
    bottom = np.sqrt(radius**2 - np.minimum(np.abs(x), width / 2) ** 2) - (radius - depth)
    h = film + np.where(np.abs(x) < width / 2, bottom, 0.0)
    flow = speed / 2 * np.trapezoid(h**-2, x) / np.trapezoid(h**-3, x)
    gradient = 6 * viscosity * speed / h**2 - 12 * viscosity * flow / h**3
    pressure = np.concatenate([[0.0], np.cumsum((gradient[1:] + gradient[:-1]) / 2 * np.diff(x))])
    shear = 4 * viscosity * speed / h - 6 * viscosity * flow / h**2
    return np.trapezoid(shear, x) / length, pressure.max()


@pytest.mark.parametrize("film", [5e-7, 2e-6])
def test_a_film_of_flat_cells_is_that_of_reynolds(film):
    """Films of 1/20 000 and 1/5000 of their length, Re at most 0.2: neither inertia nor slope changes friction."""
    scene = read_scene(
        {
            "name": "flat cells",
            "kind": "pocket",
            "geometry": {
                "length": "10 mm",
                "film": f"{film} m",
                "profile": "cylindrical",
                "width": "3 mm",
                "depth": "0.3 um",
            },
            "lubricant": {"viscosity": "0.01 Pa*s", "density": "1000 kg/m^3"},
            "motion": {"speed": "1 m/s"},
        }
    )
    coarse, fine = (NAVIER_STOKES.solve(scene, Request(resolution=n)) for n in (60, 120))
    friction, peak = of_reynolds(film)
    extrapolated = fine["friction_per_area"].value * 4 / 3 - coarse["friction_per_area"].value / 3
    assert extrapolated == pytest.approx(friction, rel=2e-5)
    unit = scene.pressure_unit / scene.plus_factor
    assert fine["pressure_max_plus"].value * unit == pytest.approx(peak, rel=0.05)
    assert abs(fine["load_per_area"].value) < 1e-5 * peak
