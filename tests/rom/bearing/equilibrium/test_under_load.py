"""Bearings under a load: closed forms and published tables turned round, round trips, the whole bearing, refusals."""

import math
from typing import Any

import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import find
from roughfilm.rom.bearing.equilibrium.expected import expected_film
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import read_scene, scene_entries

OIL = {"viscosity": "0.02 Pa*s"}
WEDGE = {"shape": "linear", "length": "20 mm", "film": "10 um", "rise": "12 um"}
JOURNAL = {"shape": "journal", "radius": "25 mm", "clearance": "25 um", "width": "50 mm"}
SECTOR = {
    "shape": "sector",
    "inner_radius": "40 mm",
    "outer_radius": "80 mm",
    "angle": "45 deg",
    "film": "10 um",
    "rise": "20 um",
}
WASHER = {
    "shape": "washer",
    "inner_radius": "150 mm",
    "outer_radius": "180 mm",
    "pockets": 30,
    "film": "10 um",
    "pocket": {"depth": "0.5 mm", "share": 0.5, "extent": "15 mm"},
}
FED = {"boundary": {"sides": {"low": "1 bar"}}, "lubricant": OIL | {"cavitation_pressure": "-1 bar"}}
RIDGES = {"kind": "sinusoid", "amplitude": "4 um", "wavelength": "0.5 mm"}
GROUND = {
    "kind": "gaussian",
    "size": ["0.3 mm", "0.3 mm"],
    "points": [32, 32],
    "seed": 7103,
    "rms_height": "1.2 um",
    "correlation_length": "40 um",
}
TOUCHING = {
    "geometry": WEDGE | {"width": "16 mm", "film": "2.2 um", "rise": "0.8 um"},
    "roughness": {"kind": "surface", "surface": GROUND},
    "asperities": {"friction": 0.12, "solid": {"modulus": "70 GPa", "poisson": 0.3, "hardness": "2 GPa"}},
}


def scene(geometry: dict[str, Any], **tables: Any) -> Bearing:
    """A bearing that slides at 2 m/s in oil."""
    entries = {"name": "bearing", "kind": "bearing", "lubricant": OIL, "motion": {"speed": "2 m/s"}}
    read = read_scene(entries | {"geometry": geometry} | tables)
    assert isinstance(read, Bearing)
    return read


def loaded(given: Bearing, load: dict[str, str]) -> Bearing:
    """The bearing with a load instead of its film."""
    entries = scene_entries(given)
    for key in ("film", "eccentricity"):
        entries["geometry"].pop(key, None)
    read = read_scene(entries | {"load": load})
    assert isinstance(read, Bearing)
    return read


def solve(taken: Bearing, model: str = "reynolds_cavitating", cells: int = 32) -> Result:
    return find("bearing", model).solve(taken, Request(resolution=cells))


def value(result: Result, name: str) -> float:
    return result.quantities[name].value


def test_a_full_wide_journal_has_the_eccentricity_of_sommerfeld() -> None:
    e = 0.7  # W = 12 π η u (R/c)² ε / ((2 + ε²) √(1 - ε²)) without cavitation
    force = 12 * math.pi * 0.02 * 2 * 1e6 * e / ((2 + e**2) * math.sqrt(1 - e**2))
    wide = {name: entry for name, entry in JOURNAL.items() if name != "width"}
    result = solve(scene(wide, load={"force_per_width": f"{force!r} N/m"}), "reynolds", 1024)
    found = result.quantities["eccentricity"]
    assert found.value == pytest.approx(e, rel=1e-4)
    assert found.uncertainty is not None
    assert abs(found.value - e) <= found.uncertainty
    assert value(result, "attitude_angle") == pytest.approx(90, abs=1e-3)


@pytest.mark.parametrize("e", [0.3, 0.8])
def test_a_narrow_journal_has_the_eccentricity_of_ocvirk(e: float) -> None:
    width = 50e-3 / 32  # W = η u B³ ε √(16 ε² + π² (1 - ε²)) / (4 c² (1 - ε²)²) in the limit of a small width
    force = 0.02 * 2 * width**3 * e * math.sqrt(16 * e**2 + math.pi**2 * (1 - e**2)) / (4 * 25e-6**2 * (1 - e**2) ** 2)
    result = solve(scene(JOURNAL | {"width": f"{width!r} m"}, load={"force": f"{force!r} N"}), cells=96)
    assert value(result, "eccentricity") == pytest.approx(e, abs=0.01)


@pytest.mark.parametrize(("sommerfeld", "e"), [(0.264, 0.4), (0.121, 0.6), (0.0446, 0.8)])
def test_a_journal_as_long_as_wide_has_the_eccentricity_of_raimondi_and_boyd(sommerfeld: float, e: float) -> None:
    revolutions = 2 / (2 * math.pi * 25e-3)
    force = 0.02 * revolutions * 50e-3 * 50e-3 * 1e6 / sommerfeld
    result = solve(scene(JOURNAL, load={"force": f"{force!r} N"}), cells=64)
    assert value(result, "sommerfeld_number") == pytest.approx(sommerfeld, rel=1e-5)
    assert value(result, "eccentricity") == pytest.approx(e, abs=0.006)


def test_a_wide_wedge_has_the_film_of_its_closed_form() -> None:
    film, rise, length = 8e-6, 12e-6, 20e-3
    ratio = rise / film
    force = 6 * 0.02 * 2 * (length / rise) ** 2 * (math.log(1 + ratio) - 2 * ratio / (2 + ratio))
    result = solve(scene(WEDGE, load={"force_per_width": f"{force!r} N/m"}), "reynolds", 512)
    found = result.quantities["film_min"]
    assert found.value == pytest.approx(film, rel=1e-5)
    assert found.uncertainty is not None
    assert abs(found.value - film) <= found.uncertainty


@pytest.mark.parametrize(
    ("model", "geometry", "tables"),
    [
        ("reynolds", WEDGE | {"width": "30 mm"}, {}),
        ("infinitely_wide", WEDGE | {"width": "30 mm"}, {}),
        ("reynolds_incompressible", WEDGE, {"boundary": {"inlet": {"theta": 0.9}}}),
        ("reynolds_cavitating", JOURNAL | {"eccentricity": 0.01}, {}),
        ("reynolds_cavitating", JOURNAL | {"eccentricity": 0.6}, {"motion": {"speed": "-2 m/s"}}),
        ("reynolds_cavitating", JOURNAL | {"eccentricity": 0.999}, {}),
        ("infinitely_wide", JOURNAL | {"eccentricity": 0.9}, {}),
        ("reynolds_cavitating", SECTOR | {"pads": 7}, {}),
        ("reynolds_cavitating", SECTOR | {"joined": True}, {"boundary": {"sides": {"low": "1 bar", "high": "1 bar"}}}),
        ("reynolds_cavitating", WASHER, FED),
        ("homogenized", WEDGE, {"roughness": RIDGES}),
        ("homogenized", WEDGE | {"width": "20 mm"}, {"roughness": RIDGES | {"direction": "40 deg"}}),
        ("direct", WEDGE, {"roughness": RIDGES}),
        ("mixed", TOUCHING["geometry"], {name: table for name, table in TOUCHING.items() if name != "geometry"}),
    ],
)
def test_the_load_of_a_film_gives_the_film_back(model: str, geometry: dict[str, Any], tables: dict[str, Any]) -> None:
    taken = scene(geometry, **tables)
    line = taken.wide or model == "infinitely_wide"
    cells = 640 if model == "direct" else 256 if line else 32
    given = solve(taken, model, cells)
    width, pieces = taken.geometry.width, taken.pieces
    assert pieces is not None
    if width is None:
        load = {"force_per_width": f"{value(given, 'load_per_width')!r} N/m"}
    else:
        load = {"force": f"{value(given, 'load_per_width') * width * pieces!r} N"}
    found = solve(loaded(taken, load), model, cells)
    assert value(found, "film_min") == pytest.approx(value(given, "film_min"), rel=1e-6)
    for name in ("friction_per_width", "pressure_max"):
        assert value(found, name) == pytest.approx(value(given, name), rel=1e-4), name
    assert value(found, "load_per_width") == pytest.approx(value(given, "load_per_width"), rel=1e-6)
    assert found.numerics.details["balance"] <= 1e-7


def test_a_force_is_the_pressure_times_the_nominal_area() -> None:
    for geometry, area in ((JOURNAL, 50e-3 * 50e-3), (WEDGE | {"width": "30 mm"}, 20e-3 * 30e-3)):
        bare = scene({name: one for name, one in geometry.items() if name != "film"}, load={"pressure": "1 MPa"})
        one, other = solve(bare), solve(loaded(bare, {"force": f"{1e6 * area!r} N"}))
        assert value(one, "load") == pytest.approx(1e6 * area, rel=1e-6)
        assert value(other, "film_min") == pytest.approx(value(one, "film_min"), rel=1e-7)


def test_a_force_on_a_ring_is_shared_by_its_pieces() -> None:
    for geometry, pieces, tables in ((SECTOR | {"pads": 7}, 7, {}), (WASHER, 30, FED)):
        result = solve(loaded(scene(geometry, **tables), {"force": "60 kN"}))
        assert value(result, "load") == pytest.approx(60e3 / pieces, rel=1e-6)
    with pytest.raises(InputError, match=r"load\.force: is that of the whole bearing.*geometry\.pads"):
        loaded(scene(SECTOR), {"force": "60 kN"})


def test_the_given_film_is_only_the_first_value_of_the_search() -> None:
    load = {"load": {"pressure": "1 MPa"}}
    films = [
        value(solve(scene(WEDGE | {"width": "30 mm", "film": f"{film} um"}, **load)), "film_min") for film in (1, 90)
    ]
    assert films[0] == pytest.approx(films[1], rel=1e-6)


def test_more_load_means_less_film_and_more_speed_more() -> None:
    def film(load: str, speed: str) -> float:
        return value(solve(scene(JOURNAL, load={"force": load}, motion={"speed": speed})), "film_min")

    assert film("1 kN", "2 m/s") > film("5 kN", "2 m/s") > film("20 kN", "2 m/s")
    assert film("5 kN", "1 m/s") < film("5 kN", "2 m/s") < film("5 kN", "4 m/s")


@pytest.mark.parametrize(("geometry", "tables"), [(JOURNAL, {}), (WEDGE | {"width": "20 mm"}, {}), (WASHER, FED)])
def test_the_uncertainty_under_a_load_covers_a_finer_grid(geometry: dict[str, Any], tables: dict[str, Any]) -> None:
    taken = loaded(
        scene(geometry | ({"eccentricity": 0.5} if geometry is JOURNAL else {}), **tables), {"pressure": "1 MPa"}
    )
    coarse, fine = solve(taken, cells=64), solve(taken, cells=256)
    for name in ("film_min", "friction_per_width", "friction_coefficient", "pressure_max"):
        uncertainty = coarse.quantities[name].uncertainty
        assert uncertainty is not None
        assert 0 < abs(value(coarse, name) - value(fine, name)) <= uncertainty, name


def test_of_two_films_that_carry_the_load_the_stable_one_is_taken() -> None:
    pockets = {"profile": "cylindrical", "length": "4 mm", "width": "6 mm", "depth": "5 um", "start": "1 mm"}
    flat = {"shape": "parallel", "length": "20 mm", "width": "20 mm", "texture": pockets}
    oil = {"lubricant": OIL | {"cavitation_pressure": "-1 bar"}}
    thin = solve(scene(flat | {"film": "3 um"}, **oil))
    result = solve(scene(flat | {"film": "3 um"}, load={"pressure": f"{value(thin, 'specific_load')!r} Pa"}, **oil))
    film = value(result, "film_min")
    assert film > 4e-6
    above = solve(scene(flat | {"film": f"{1.01 * film!r} m"}, **oil))
    assert value(above, "specific_load") < value(result, "specific_load")


def test_the_expected_film_is_near_the_film() -> None:
    for geometry in (JOURNAL, {name: one for name, one in WEDGE.items() if name != "film"} | {"width": "20 mm"}):
        taken = scene(geometry, load={"pressure": "1 MPa"})
        film = value(solve(taken, cells=96), "film_min")
        assert expected_film(taken).thickness == pytest.approx(film, rel=0.03)


REFUSED = [
    (scene, WEDGE | {"film": None}, {}, r"^scene\.geometry\.film: is missing; give it, or a load"),
    (scene, JOURNAL, {}, r"^scene\.geometry\.eccentricity: is missing; give it, or a load"),
    (scene, WEDGE, {"load": {}}, "is empty; give pressure, force or force_per_width"),
    (scene, WEDGE, {"load": {"pressure": "1 Pa", "force": "1 N"}}, "got pressure and force; give one"),
    (scene, WEDGE, {"load": {"force": "1 N"}}, "force for an infinitely wide bearing"),
    (scene, JOURNAL, {"load": {"force_per_width": "1 N/m"}}, "for a bearing with a width"),
    (scene, JOURNAL, {"load": {"force": "1 N"}, "motion": {"speed": "0 m/s"}}, "got 0 m/s under a load"),
]


@pytest.mark.parametrize(("read", "geometry", "tables", "message"), REFUSED)
def test_scenes_without_a_film_or_with_a_wrong_load_are_refused(
    read: Any, geometry: dict[str, Any], tables: dict[str, Any], message: str
) -> None:
    with pytest.raises(InputError, match=message) as caught:
        read({name: one for name, one in geometry.items() if one is not None}, **tables)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("model", "geometry", "tables", "message"),
    [
        ("reynolds_cavitating", {"shape": "parallel", "length": "20 mm"}, {}, "no film carries a load"),
        ("reynolds_cavitating", WEDGE, {"motion": {"speed": "-2 m/s"}}, "no film carries a load"),
        ("reynolds_cavitating", WEDGE, {"load": {"pressure": "1e6 GPa"}}, "carry at most"),
        ("homogenized", WEDGE, {"load": {"pressure": "1 GPa"}, "roughness": RIDGES}, r"mixed with \[asperities\]"),
        ("reynolds_cavitating", WASHER, FED | {"load": {"pressure": "1 kPa"}}, "carries at least"),
    ],
)
def test_a_load_that_no_film_carries_is_refused(
    model: str, geometry: dict[str, Any], tables: dict[str, Any], message: str
) -> None:
    taken = scene(geometry, **({"load": {"pressure": "1 MPa"}} | tables))
    with pytest.raises(InputError, match=message) as caught:
        solve(taken, model)
    assert str(caught.value).startswith("load: got")
    assert "\n" not in str(caught.value)
