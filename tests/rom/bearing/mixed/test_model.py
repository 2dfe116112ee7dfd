"""The mixed model at given separations: film and asperities of bearings that have closed forms."""

import math

import numpy as np
import pytest

from roughfilm import rom
from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import find
from roughfilm.rom.bearing.closed_forms.sliding import linear_slider
from roughfilm.rom.bearing.march.solve import march_bearing
from roughfilm.rom.bearing.mixed.stribeck import stribeck
from roughfilm.rom.ladder.model import Effect, ladder, of_kind, one_effect_away
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene, scene_entries

MODELS = of_kind(ladder(rom), "bearing")
MIXED, HOMOGENIZED, DIRECT = (find("bearing", name) for name in ("mixed", "homogenized", "direct"))

PARALLEL = {"shape": "parallel", "length": "20 mm", "width": "10 mm", "film": "1 um"}
LINEAR = {"shape": "linear", "length": "20 mm", "film": "1 um", "rise": "1.5 um"}
WASHER = {
    "shape": "washer",
    "inner_radius": "150 mm",
    "outer_radius": "180 mm",
    "pockets": 30,
    "film": "1 um",
}


def value(result, name):
    return result.quantities[name].value


def test_the_mixed_model_includes_the_effects_of_homogenized():
    assert MIXED.keeps - HOMOGENIZED.keeps == {Effect.DEFORMATION, Effect.PLASTICITY}
    assert HOMOGENIZED.keeps < MIXED.keeps
    assert {effect for _, effect in one_effect_away(MIXED, MODELS)} == {Effect.SHEAR_THINNING}


def test_a_mixed_scene_is_read_back_from_its_entries(tips):
    scene = tips.scene(PARALLEL)
    assert read_scene(scene_entries(scene)) == scene


def test_asperities_alone_carry_their_pressure_over_the_area(tips):
    scene = tips.scene(PARALLEL, motion={"speed": "0 m/s"})
    result = MIXED.solve(scene, Request(resolution=16))
    force = float(tips.pressure(1e-6)) * 20e-3 * 10e-3
    assert value(result, "load") == pytest.approx(force)
    assert value(result, "contact_load") == pytest.approx(force)
    assert value(result, "contact_share") == pytest.approx(1)
    assert value(result, "friction_coefficient") == pytest.approx(tips.friction)
    assert value(result, "contact_pressure_max") == pytest.approx(tips.stiffness * 0.5**1.5)
    assert value(result, "contact_area") == pytest.approx(float(tips.pressure(1e-6)) / 1e9)
    assert value(result, "least_gap") == pytest.approx(1e-6)
    assert result.fields["contact_pressure"].values == pytest.approx(float(tips.pressure(1e-6)))
    assert result.fields["mean_gap"].values == pytest.approx(1e-6)


def test_a_washer_presses_on_all_of_its_land(tips):
    pocket = {"depth": "0.5 mm", "share": 0.5, "extent": "30 mm"}
    sides = {"boundary": {"sides": {"low": "0.1 MPa"}}}
    result = MIXED.solve(tips.scene(WASHER | {"pocket": pocket}, **sides), Request(resolution=32))
    land = math.pi / 30 / 2 * (0.18**2 - 0.15**2)
    edge = 1e-6 / 0.5e-3 * (1 + math.log(0.5e-3 / 1e-6))  # of the pocket, where its floor touches too
    pressed = value(result, "contact_load") / (float(tips.pressure(1e-6)) * land)
    assert 1 - 1e-9 <= pressed <= 1 + edge
    whole = MIXED.solve(tips.scene(WASHER, **sides), Request(resolution=32))
    assert value(whole, "contact_load") == pytest.approx(float(tips.pressure(1e-6)) * 2 * land)
    assert value(whole, "bearing_contact_load") == pytest.approx(30 * value(whole, "contact_load"))


def test_boundary_friction_takes_torque_and_power(tips):
    tables = {"boundary": {"sides": {"low": "0.1 MPa"}}, "motion": {"speed": "1e-9 m/s"}}
    result = MIXED.solve(tips.scene(WASHER, **tables), Request(resolution=32))
    turn = 2 * math.pi / 30
    torque = tips.friction * float(tips.pressure(1e-6)) * turn * (0.18**3 - 0.15**3) / 3
    assert value(result, "torque") == pytest.approx(torque, rel=1e-3)
    assert value(result, "power_loss") == pytest.approx(torque * 1e-9 / 0.165, rel=1e-3)


def test_film_and_asperities_of_a_wedge_are_each_as_if_alone(tips):
    """∫ P₀ (1 - h/T)^1.5 dx over a film that falls by ``rise`` over L: 0.4 P₀ T L/rise (1 - h/T)^2.5 at its end."""
    scene = tips.scene(LINEAR)
    result = MIXED.solve(scene)
    slider = linear_slider(film=1e-6, rise=1.5e-6, length=20e-3, speed=0.1, viscosity=0.1)
    contact = 0.4 * tips.stiffness * tips.touching * 20e-3 / 1.5e-6 * 0.5**2.5
    assert value(result, "contact_load_per_width") == pytest.approx(contact, rel=1e-5)
    assert value(result, "film_load_per_width") == pytest.approx(slider.load, rel=1e-5)
    assert value(result, "load_per_width") == pytest.approx(contact + slider.load, rel=1e-5)
    friction = slider.friction + tips.friction * contact
    assert value(result, "friction_per_width") == pytest.approx(friction, rel=1e-5)
    assert value(result, "friction_coefficient") == pytest.approx(friction / (contact + slider.load), rel=1e-5)


def test_uncertainties_hold_the_error(tips):
    result = MIXED.solve(tips.scene(LINEAR), Request(resolution=64))
    contact = 0.4 * tips.stiffness * tips.touching * 20e-3 / 1.5e-6 * 0.5**2.5
    for name, exact in (("contact_load_per_width", contact), ("least_gap", 1e-6)):
        error = abs(value(result, name) - exact)
        assert error <= result[name].uncertainty <= max(30 * error, 1e-9 * exact)


def test_sliding_the_other_way_over_a_symmetric_wall_changes_nothing_but_the_way(tips):
    geometry = {"shape": "parabolic", "length": "20 mm", "width": "10 mm", "film": "1 um", "rise": "3 um"}
    one, other = (
        MIXED.solve(tips.scene(geometry, motion={"speed": speed}), Request(resolution=24))
        for speed in ("0.1 m/s", "-0.1 m/s")
    )
    for name in ("load", "contact_load", "friction", "contact_area", "cavitated_fraction"):
        assert value(other, name) == pytest.approx(value(one, name), rel=1e-6)
    assert other.fields["contact_pressure"].values == pytest.approx(one.fields["contact_pressure"].values[::-1])


def test_where_nothing_touches_it_is_homogenized(tips):
    """Whose table it then is, too; pads, journals and rings."""
    journal = {"shape": "journal", "radius": "10 mm", "width": "10 mm", "clearance": "9 um", "eccentricity": 0.7}
    sides = {"boundary": {"sides": {"low": "0.1 MPa"}}}
    for geometry, more in ((PARALLEL | {"film": "3 um"}, {}), (journal, {}), (WASHER | {"film": "2.5 um"}, sides)):
        scene = tips.scene(geometry, **more)
        mixed, film = (model.solve(scene, Request(resolution=16)) for model in (MIXED, HOMOGENIZED))
        for name, quantity in film.quantities.items():
            assert value(mixed, name) == pytest.approx(quantity.value, rel=1e-12), name
        assert mixed.fields["pressure"].values == pytest.approx(film.fields["pressure"].values, rel=1e-12)
        assert value(mixed, "contact_load") == 0


def test_forces_on_a_journal_add_up_as_vectors(tips):
    """At rest, ∫ p_c cos φ dA over the arc that touches; all of p_c rubs."""
    geometry = {"shape": "journal", "radius": "10 mm", "width": "10 mm", "clearance": "3 um", "eccentricity": 0.8}
    result = MIXED.solve(tips.scene(geometry, motion={"speed": "0 m/s"}), Request(resolution=256))
    angle = np.linspace(-np.pi, np.pi, 200_001)
    pressure = tips.pressure(3e-6 * (1 - 0.8 * np.cos(angle)))
    load, pressed = (float(np.trapezoid(p, angle)) * 1e-4 for p in (pressure * np.cos(angle), pressure))
    assert value(result, "load") == pytest.approx(load, rel=2e-4)
    assert value(result, "friction") == pytest.approx(tips.friction * pressed, rel=2e-4)


def test_a_place_that_is_sealed_keeps_a_pressure_between_those_of_its_ends(tips, tmp_path):
    sealed = {"pressure": np.zeros((2, 2)), "shear": np.zeros(2), "sealed": (True, True)}
    scene = tips.scene(
        {"shape": "parabolic", "length": "20 mm", "width": "10 mm", "film": f"{tips.closest!r} m", "rise": "3 um"},
        path=tips.stored(tmp_path / "sealed.h5", **sealed),
        boundary={"inlet": {"pressure": "1 MPa"}},
    )
    result = MIXED.solve(scene, Request(resolution=32))
    assert np.isfinite(result.fields["pressure"].values).all()
    rest = MIXED.solve(
        scene.model_copy(update={"motion": scene.motion.model_copy(update={"speed": 0.0})}), Request(resolution=32)
    )
    pressure = rest.fields["pressure"].values
    assert pressure.min() >= -1e-3
    assert pressure.max() <= 1e6 * (1 + 1e-9)


def test_scenes_outside_the_range_of_the_model_are_refused(tips):
    scene = tips.scene(PARALLEL | {"film": "0.1 um"})
    with pytest.raises(InputError, match=r"separation: got 1e-07 m; it must be at least 2e-07 m"):
        MIXED.solve(scene, Request(resolution=16))
    entries = scene_entries(tips.scene(PARALLEL))
    smooth = {name: table for name, table in entries.items() if name not in ("roughness", "asperities")}
    fits = MIXED.applies(read_scene(smooth))
    assert not fits.applies
    assert "has no table asperities" in fits.reason
    fits = DIRECT.applies(read_scene(entries))
    assert not fits.applies
    assert "has no waves" in fits.reason
    assert "leaves out the contact load" in HOMOGENIZED.applies(read_scene(entries)).reason


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"roughness": None}, "asperities: got a table for smooth walls"),
        (
            {"roughness": {"kind": "sinusoid", "amplitude": "0.1 um", "wavelength": "1 mm"}},
            "asperities: got a table for sinusoidal ridges",
        ),
        (
            {"asperities": {"solid": {"modulus": "1 GPa", "poisson": 0.3}}},
            r"asperities\.solid: got one, but the stored",
        ),
        ({"asperities": {"counter": {"modulus": "1 GPa", "poisson": 0.3}}}, r"asperities\.solid: is missing, but"),
        ({"asperities": {"friction": -1}}, r"asperities\.friction: got -1\.0; it must be 0 to 10"),
        ({"asperities": {"frictions": 1}}, r"asperities\.frictions: unknown key; did you mean 'friction'"),
        ({"roughness": {"kind": "table", "table": "nowhere.h5"}}, r"roughness\.table: in nowhere\.h5: no such file"),
        ({"roughness": {"kind": "surface", "surface": {"kind": "sinusoid"}}}, "roughness"),
    ],
)
def test_each_error_is_reported_in_one_line(tips, changes, words):
    entries = scene_entries(tips.scene(PARALLEL)) | changes
    with pytest.raises(InputError, match=words) as caught:
        read_scene({name: table for name, table in entries.items() if table is not None})
    assert all(line.startswith("scene.") for line in str(caught.value).splitlines())


def test_a_file_that_is_no_table_and_another_table_are_refused(tips, tmp_path):
    scene = tips.scene(PARALLEL)
    written = scene_entries(scene)
    tips.stored(tmp_path / "table.h5", couette=9e6)
    with pytest.raises(InputError, match=r"roughness\.digest: got .* leave the digest out to accept it"):
        read_scene(written)
    (tmp_path / "table.h5").write_bytes(b"nothing")
    del written["roughness"]["digest"]
    with pytest.raises(InputError, match=r"roughness\.table: in .*table\.h5: is no table of flow factors"):
        read_scene(written)


FEW = {
    "kind": "surface",
    "surface": {
        "kind": "milled",
        "size": ["9.2 mm", "16 mm"],
        "points": [8, 16],
        "radius": "36 mm",
        "feed": "9.2 mm",
        "depth": "40 um",
    },
}


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"asperities": {"solid": {"modulus": "0.2 GPa", "poisson": 0.2, "hardness": "60 kPa"}}},
        {"geometry": {"shape": "parallel", "length": "40 mm", "film": "15 um"}},
    ],
)
def test_a_roughness_of_few_points_has_no_uncertainty_and_a_warning(changes):
    """Where all faces are closed nothing rubs, and where no coarser grid is nothing says how far off pressures are."""
    entries = {
        "name": "few points",
        "kind": "bearing",
        "geometry": {"shape": "parallel", "length": "40 mm", "width": "75 mm", "film": "15 um"},
        "lubricant": {"viscosity": "0.3 Pa*s", "cavitation_pressure": "-20 kPa"},
        "motion": {"speed": "10 mm/s"},
        "roughness": FEW,
        "asperities": {"friction": 0.1, "solid": {"modulus": "10 GPa", "poisson": 0.0}},
    }
    result = MIXED.solve(read_scene(entries | changes), Request(resolution=32))
    known = {name: one.uncertainty for name, one in result.quantities.items() if one.uncertainty is not None}
    assert known
    assert all(math.isfinite(uncertainty) for uncertainty in known.values())
    assert "contact_load_per_width" not in known
    assert value(result, "contact_load_per_width") > 0
    assert any("contact_load_per_width" in warning and "too few points" in warning for warning in result.warnings)


MEAN, PEAK, MODULUS = 1e9, 1.5e9, {"soft": 3e9, "firm": 4e9, "stiff": 6e9}


@pytest.mark.parametrize("name", MODULUS)
def test_spots_beyond_linear_elasticity_are_named_and_beyond_their_mean_promise_nothing(tips, tmp_path, name):
    path = tips.stored(tmp_path / "T.h5", modulus=MODULUS[name], peak=PEAK)
    scene = tips.scene(PARALLEL, path=path)
    limit = 0.3 * MODULUS[name]
    result = MIXED.solve(scene, Request(resolution=16))
    (curve,) = stribeck(scene, [0.05], [5e6], resolution=16)
    moving = scene.model_copy(update={"motion": scene.motion.model_copy(update={"approach": -1e-6})})
    march = march_bearing(moving, end=0.01, steps=2, cells=(16, 16), uncertain=False)
    peaks, means = (
        [any(f"{which} pressure of the contacts" in one for one in words) for words in found]
        for which, found in (
            ("peak", (result.warnings, march.warnings)),
            ("mean", (result.outside, curve.points[0].outside, march.outside)),
        )
    )
    assert peaks == 2 * [limit < PEAK]
    assert means == 3 * [limit < MEAN]


def test_walls_that_do_not_touch_have_no_spots(tips, tmp_path):
    path = tips.stored(tmp_path / "T.h5", modulus=1e6, peak=PEAK)
    result = MIXED.solve(tips.scene(PARALLEL | {"film": "4 um"}, path=path), Request(resolution=16))
    assert not any("elasticity" in one for one in (*result.warnings, *result.outside))
