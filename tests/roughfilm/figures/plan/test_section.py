"""The flow in a section of a cell in plan, from a known flow."""

import numpy as np
import pytest
from places import SCENES

from roughfilm.figures.plan.section import even, in_section, section
from roughfilm.figures.spatial.dimples import SPEED, film_around
from roughfilm.rom.ladder.result import Field, Numerics, Result
from roughfilm.rom.ladder.scene import load_scene, scene_entries


@pytest.fixture(scope="module")
def dimple():
    return load_scene(SCENES / "dimple.toml", ["geometry.dimples.0.depth=20 um", "motion.reynolds_number=1"])


@pytest.fixture(scope="module")
def sheared(dimple):
    """A result whose velocity is u y/B + u (z - low)/h along x, and that of the wall's slope along z."""
    plan, counts = dimple.plan(), (40, 24, 8)
    x, y = (
        np.linspace(-side / 2, side / 2, n + 1) for side, n in zip((plan.length, plan.breadth), counts, strict=False)
    )
    gap = plan.thickness(x[:, None], y)
    up = np.linspace(0, 1, counts[2] + 1)
    z = plan.film - gap[..., None] * (1 - up)
    vertices = np.stack(np.broadcast_arrays(x[:, None, None], y[:, None], z), axis=-1)
    middle = (y[1:] + y[:-1]) / 2
    levels = (up[1:] + up[:-1]) / 2
    along = dimple.speed * (levels + middle[:, None] / plan.breadth) * np.ones((counts[0], 1, 1))
    velocity = np.stack([along, 0 * along, 0 * along], axis=-1)
    places = np.meshgrid((x[1:] + x[:-1]) / 2, middle, indexing="ij")
    fields = {"x": places[0], "y": places[1], "pressure": 1e3 * places[0] / plan.length}
    return Result(
        model="navier_stokes",
        quantities={},
        fields={
            **{name: Field(values=values, unit="m") for name, values in fields.items()},
            "vertices": Field(values=vertices, unit="m"),
            "cell_velocity": Field(values=velocity, unit="m/s"),
        },
        provenance={"scene": scene_entries(dimple)},
        numerics=Numerics(
            residual=0.0,
            iterations=1,
            cpu_s=0.0,
            wall_s=0.0,
            degrees_of_freedom=1,
            resolution=40,
            tolerance=1e-9,
            scheme="",
        ),
    )


def test_the_section_has_the_walls_and_the_flow_between_the_rows_of_cells(dimple, sheared):
    x, z, velocity = in_section(dimple, sheared)
    assert z[:, -1] == pytest.approx(np.full(x.size, dimple.geometry.film))
    assert z[:, 0].min() == pytest.approx(-20e-6, rel=0.05)
    part = (z - z[:, :1]) / (z[:, -1:] - z[:, :1])
    assert velocity[..., 0] == pytest.approx(dimple.speed * part, abs=1e-9 * dimple.speed)


def test_the_even_grid_has_no_flow_below_the_wall(dimple, sheared):
    along, up, u, _ = even(*in_section(dimple, sheared))
    low = dimple.geometry.film - dimple.plan().thickness(along[:, None], np.zeros(1))
    clear = np.abs(up - low) > 2e-6  # the wall between the columns is straight
    assert (np.isnan(u) == (up < low))[clear].all()
    assert np.nanmax(u) == pytest.approx(dimple.speed)


def test_the_figure_names_its_axes_and_units(dimple, sheared, monkeypatch):
    figures = []
    monkeypatch.setattr("roughfilm.figures.plan.section.svg", lambda figure: figures.append(figure) or "")
    section(dimple, sheared)
    labels = {axes.get_xlabel() for axes in figures[0].axes} | {axes.get_ylabel() for axes in figures[0].axes}
    assert {"position x along the sliding, µm", "height z, µm", "speed over sliding speed"} <= labels


def test_the_picture_shows_the_film_around_the_dimple(dimple, sheared):
    film = film_around(dimple, sheared)
    assert max(abs(place) for place in film.bounds[:4]) == pytest.approx(300, abs=50)  # µm, twice the radius
    assert film[SPEED].max() == pytest.approx((1 - 1 / 16) + 0.25, abs=0.05)
