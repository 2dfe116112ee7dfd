"""Washers and films given by points: their shapes, what is refused, and flows that have closed forms."""

import math

import numpy as np
import pytest
from places import SCENES

from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import find
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.solve import solve
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import load_scene, read_scene, scene_entries

SCENE = SCENES / "washer.toml"
FILM = find("bearing", "reynolds_cavitating")
INNER, OUTER, TURN = 0.15, 0.18, 2 * math.pi / 30


def washer(*overrides):
    scene = load_scene(SCENE, overrides)
    assert isinstance(scene, Bearing)
    return scene


def film_of(scene, x, y):
    places = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(y, dtype=float))
    return scene.geometry.film_shape().thickness(*places)


def test_a_washer_is_read_back_from_its_entries():
    assert read_scene(scene_entries(washer())) == washer()
    assert washer().problem().speed * 60 / (2 * math.pi) == pytest.approx(30, rel=1e-4)


def test_the_floor_rises_from_the_wall_and_from_the_inner_edge_to_the_land():
    scene = washer("geometry.pocket.start=0.25")
    angle = TURN * np.array([0.25 + 1e-9, 0.5, 0.75, 0.25 - 1e-9, 0.9, 1.25 + 1e-9])
    assert film_of(scene, angle, INNER) == pytest.approx(np.array([505, 255, 5, 5, 5, 505]) * 1e-6, rel=1e-6)
    radius = np.array([0.15, 0.1575, 0.165, 0.18])
    assert film_of(scene, TURN / 2, radius) == pytest.approx(np.array([255, 130, 5, 5]) * 1e-6)
    assert scene.geometry.film_shape().breaks == pytest.approx(np.array([0, 0.25, 0.75, 1]) * TURN)


@pytest.mark.parametrize(
    ("override", "words"),
    [
        ("geometry.pocket.depht=1 um", r"geometry\.pocket\.depht: unknown key; did you mean 'depth'"),
        ("geometry.pocket.share=0", r"geometry\.pocket\.share: got 0; .* greater than 0"),
        ("geometry.pocket.start=0.6", r"geometry\.pocket\.share: got 0\.5 from 0\.6 on; .* end within its cell"),
        ("geometry.pocket.start=1.5", r"geometry\.pocket\.start: got 1\.5; it must be 0 to 1"),
        ("geometry.pocket.extent=31 mm", r"geometry\.pocket\.extent: got 0\.031 m; the washer is only 0\.03"),
        ("geometry.pocket.depth=1 m", r"geometry\.pocket\.depth: got 1\.0 m, more than the outer radius"),
        ("geometry.pockets=0", r"geometry\.pockets: got 0"),
        ("geometry.inner_radius=0.2 m", r"geometry\.outer_radius: got 0\.18 m; it must be above inner_radius"),
        ("boundary.sides.low=-0.2 MPa", r"boundary\.sides\.low\.pressure: got -200000\.0 Pa; it must be at least"),
        ("boundary.inlet.theta=0.5", "boundary: got an inlet or outlet, but joined pads"),
    ],
)
def test_errors_of_a_washer_are_reported_in_one_line(override, words):
    with pytest.raises(InputError, match=words) as caught:
        washer(override)
    assert "\n" not in str(caught.value)


def test_a_washer_at_rest_without_pockets_leaks_as_the_logarithm_of_the_radii():
    """p = p₁ ln(R/r)/ln(R/r₁), Q = φ h³ p₁/(12 η ln(R/r₁)), F = φ p₁ ((R² - r₁²)/(4 ln(R/r₁)) - r₁²/2)."""
    entries = scene_entries(washer("motion.speed=0 m/s"))
    del entries["geometry"]["pocket"]
    result = solve(read_scene(entries).problem(), (8, 256))
    pressure, log = result.state.pressure - 1e5, math.log(OUTER / INNER)
    assert pressure == pytest.approx(
        np.broadcast_to(1e5 * np.log(OUTER / result.grid.y) / log, pressure.shape), abs=0.2
    )
    force = float((result.grid.areas * pressure).sum())
    assert force == pytest.approx(TURN * 1e5 * ((OUTER**2 - INNER**2) / (4 * log) - INNER**2 / 2), rel=2e-6)
    fine = result.network.conductance(np.ones_like(pressure))[1]
    flow = float((-fine[:, :-1] * np.diff(pressure, axis=1)).sum(axis=0)[-1])
    assert flow == pytest.approx(TURN * (5e-6) ** 3 * 1e5 / (12 * 0.14 * log), rel=1e-5)


def given(tmp_path, values, name="h.npy", **more):
    path = tmp_path / name
    if isinstance(values, str):
        path.write_text(values)
    else:
        np.save(path, values)
    geometry = {"shape": "given", "length": "20 mm", "width": "10 mm", "film": "10 um", "thickness": str(path), **more}
    return read_scene(
        {
            "name": "pad",
            "kind": "bearing",
            "geometry": geometry,
            "lubricant": {"viscosity": "0.1 Pa*s"},
            "motion": {"speed": "1 m/s"},
        }
    )


def test_points_of_a_wedge_are_the_wedge(tmp_path):
    points = np.linspace(14e-6, 12e-6, 7)[:, None] * np.ones(3)
    scene = given(tmp_path, points)
    assert read_scene(scene_entries(scene)) == scene
    assert film_of(scene, [0, 5e-3, 20e-3], [0, 3e-3, 10e-3]) == pytest.approx(np.array([12, 11.5, 10]) * 1e-6)
    entries = scene_entries(scene)
    entries["geometry"] = {"shape": "linear", "length": "20 mm", "width": "10 mm", "film": "10 um", "rise": "2 um"}
    wedge, same = (FILM.solve(one, Request(resolution=32)) for one in (read_scene(entries), scene))
    for name, quantity in wedge.quantities.items():
        assert same.quantities[name].value == pytest.approx(quantity.value, rel=1e-9), name


def test_points_in_a_text_file_have_the_unit_of_its_header(tmp_path):
    """A line for each y, a column for each x."""
    scene = given(tmp_path, "# spacing: 1 mm, 1 mm; heights: um\n14, 13, 12\n14, 13, 13\n", "h.csv")
    assert film_of(scene, [0, 10e-3, 20e-3], [0, 10e-3, 10e-3]) == pytest.approx(np.array([12, 11, 11]) * 1e-6)
    plain = given(tmp_path, "14e-6, 13e-6, 12e-6\n14e-6, 13e-6, 13e-6\n", "p.csv")
    assert film_of(plain, [0, 5e-3], 5e-3) == pytest.approx(np.array([12, 11.5]) * 1e-6)


@pytest.mark.parametrize(
    ("values", "name", "words"),
    [
        (np.where(np.eye(3), np.nan, 1e-6), "h.npy", "has no number at x 0, y 0"),
        (np.ones(4), "h.npy", "is a profile of 4 points"),
        (np.ones((1, 4)), "h.npy", "is a profile of 4 points"),
        ("1, 2\n3\n", "h.csv", "line 2 has 1 cells"),
        ("1, x\n", "h.csv", "got 'x'"),
        ("", "h.npy", "is empty"),
        ("1, 2\n2, 1\n", "h.txt", "is neither NPY nor CSV"),
    ],
)
def test_films_that_cannot_be_read_are_refused_in_one_line(tmp_path, values, name, words):
    with pytest.raises(InputError, match=words) as caught:
        given(tmp_path, values, name)
    assert str(caught.value).startswith("scene.geometry.thickness: ")
    assert "\n" not in str(caught.value)


def test_another_film_under_the_same_name_is_refused(tmp_path):
    written = scene_entries(given(tmp_path, np.array([[1e-6, 2e-6], [3e-6, 4e-6]])))
    np.save(tmp_path / "h.npy", np.array([[1e-6, 2e-6], [3e-6, 5e-6]]))
    with pytest.raises(InputError, match=r"geometry\.digest: got .* leave the digest out to accept them"):
        read_scene(written)


def test_a_film_file_is_relative_to_its_scene(tmp_path):
    scene = given(tmp_path, np.array([[1e-6, 2e-6], [3e-6, 4e-6]]))
    text = SCENE.read_text().split("[lubricant]")[1]
    head = 'name = "pad"\nkind = "bearing"\n[geometry]\nshape = "given"\nlength = "20 mm"\nwidth = "10 mm"\n'
    (tmp_path / "pad.toml").write_text(head + 'film = "10 um"\nthickness = "h.npy"\n[lubricant]' + text)
    result = load_scene(tmp_path / "pad.toml").geometry
    assert result.digest == scene.geometry.digest
    with pytest.raises(InputError, match=r"scene\.geometry\.thickness: in .*other\.npy: no such file"):
        load_scene(tmp_path / "pad.toml", ["geometry.thickness=other.npy"])
