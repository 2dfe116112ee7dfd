"""Loads shared by film and asperities: the separation under a load, sweeps of speed, lift-off."""

import dataclasses
import math

import numpy as np
import pytest
from scipy.optimize import brentq

from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import find
from roughfilm.rom.bearing.closed_forms.sliding import linear_slider
from roughfilm.rom.bearing.equilibrium.balance import FilmsAtSpeed, balanced
from roughfilm.rom.bearing.mixed.asperity_table import AsperityTable
from roughfilm.rom.bearing.mixed.equilibrium import equilibrium
from roughfilm.rom.bearing.mixed.film import MixedFilm
from roughfilm.rom.bearing.mixed.search.separation import SeparationSearch
from roughfilm.rom.bearing.mixed.stribeck import stribeck
from roughfilm.rom.ladder.request import Request

MIXED = find("bearing", "mixed")
PARALLEL = {"shape": "parallel", "length": "20 mm", "width": "10 mm", "film": "1 um"}
LINEAR = {"shape": "linear", "length": "20 mm", "film": "1 um", "rise": "1.5 um"}
PAD = LINEAR | {"width": "20 mm", "rise": "5 um"}
JOURNAL = {"shape": "journal", "radius": "10 mm", "width": "10 mm", "clearance": "10 um", "eccentricity": 0.5}
WASHER = {
    "shape": "washer",
    "inner_radius": "150 mm",
    "outer_radius": "180 mm",
    "pockets": 30,
    "film": "1 um",
    "pocket": {"depth": "0.5 mm", "share": 0.5, "extent": "15 mm"},
}
FED = {"boundary": {"sides": {"low": "0.1 MPa"}}}
TOLERANCE = 1e-6


def at_speed(scene, speed):
    return scene.model_copy(update={"motion": scene.motion.model_copy(update={"speed": speed})})


@pytest.mark.parametrize("pressure", [1e3, 1e6, 30e6])
def test_at_rest_asperities_alone_carry_a_parallel_pad(tips, pressure):
    scene = tips.scene(PARALLEL, motion={"speed": "0 m/s"})
    result = equilibrium(scene, pressure, resolution=16)
    assert result.separation == pytest.approx(tips.touching * (1 - (pressure / tips.stiffness) ** (2 / 3)), rel=1e-6)
    assert result.friction_coefficient == pytest.approx(tips.friction, rel=1e-12)
    assert result.contact_share == pytest.approx(1, rel=1e-12)
    assert result.load == pytest.approx(pressure * 2e-4, rel=TOLERANCE)


@pytest.mark.parametrize(("pressure", "speed"), [(0.5e6, 1.0), (2e6, 1.0), (2e6, 0.1), (20e6, 0.1)])
def test_a_wedge_lies_where_its_closed_forms_balance(tips, pressure, speed):
    """The slider's film of linear_slider, and 0.4 P₀ T L/rise [(1 - h/T)^2.5] of asperities that touch at its end."""

    def carried(film):
        slider = linear_slider(film=film, rise=1.5e-6, length=20e-3, speed=speed, viscosity=0.1)
        ends = (max(1 - h / tips.touching, 0.0) ** 2.5 for h in (film, film + 1.5e-6))
        near, far = ends
        contact = 0.4 * tips.stiffness * tips.touching * 20e-3 / 1.5e-6 * (near - far)
        return slider, contact

    film = brentq(lambda h: carried(h)[0].load + carried(h)[1] - pressure * 20e-3, tips.closest, 1e-3, xtol=1e-16)
    slider, contact = carried(film)
    result = equilibrium(at_speed(tips.scene(LINEAR), speed), pressure, resolution=512)
    assert result.separation == pytest.approx(film, rel=3e-5)
    assert result.least_gap == result.separation
    assert result.contact_load == pytest.approx(contact, rel=3e-4, abs=1e-9)
    assert result.friction == pytest.approx(slider.friction + tips.friction * contact, rel=1e-4)
    assert result.balance <= TOLERANCE


@pytest.mark.parametrize(
    ("geometry", "more", "pressure"),
    [(PAD, {}, 5e6), (JOURNAL, {}, 2e6), (WASHER, FED, 1e6), (JOURNAL | {"width": "4 mm"}, {}, 20e6)],
)
def test_the_model_carries_the_load_at_the_solved_separation(tips, geometry, more, pressure):
    scene = tips.scene(geometry, **more)
    point = equilibrium(scene, pressure, resolution=32)
    assert 0 < point.contact_share < 1
    there = scene.model_copy(update={"geometry": scene.geometry.at_film(point.separation)})
    result = MIXED.solve(there, Request(resolution=32))
    area = 2 * 10e-3 * scene.geometry.width if geometry["shape"] == "journal" else point.load / pressure
    assert result.quantities["load"].value == pytest.approx(pressure * area, rel=1e-5)
    for name in ("contact_load", "friction", "friction_coefficient", "pressure_max", "contact_area", "contact_share"):
        assert getattr(point, name) == pytest.approx(result.quantities[name].value, rel=1e-4), name


def test_loads_beyond_the_asperities_are_refused_with_the_largest(tips):
    scene = tips.scene(WASHER, **FED)
    with pytest.raises(InputError, match="carry at most") as caught:
        equilibrium(scene, 1e9, resolution=16)
    most = float(str(caught.value).split("carry at most ")[1].split(" Pa")[0])
    assert 0.5 * tips.pressure(tips.closest) < most < 2 * tips.pressure(tips.closest)
    assert equilibrium(scene, 0.999 * most, resolution=16).separation == pytest.approx(tips.closest, rel=0.05)
    with pytest.raises(InputError, match="carry at most"):
        equilibrium(scene, 1.001 * most, resolution=16)


def test_a_load_below_that_at_any_separation_is_refused(tips):
    scene = tips.scene(PARALLEL, motion={"speed": "0 m/s"}, boundary={"inlet": {"pressure": "3 MPa"}})
    with pytest.raises(InputError, match="at any separation; raise the load"):
        equilibrium(scene, 1e5, resolution=16)


def test_a_journal_with_too_large_a_load_reports_the_largest_load(tips):
    with pytest.raises(InputError, match="carry at most"):
        equilibrium(tips.scene(JOURNAL), 1e9, resolution=16)


def test_whole_films_of_a_plain_liquid_carry_in_proportion_to_speed(tips):
    """Beside what the pressures at the ends carry at rest."""
    scene = tips.scene(PAD, lubricant={"viscosity": "0.1 Pa*s", "cavitation_pressure": "-100 MPa"})
    film = MixedFilm(scene=scene, asperities=tips.table(), cells=24)
    rest, one, three = (film.at(1e-6, speed).film_load for speed in (0.0, 0.1, 0.3))
    assert three - rest == pytest.approx(3 * (one - rest), rel=1e-9)


def test_lift_off_is_where_the_film_just_carries(tips):
    """A film without pressure at its ends carries in proportion to speed: twice the load lifts at twice the speed."""
    scene = tips.scene(LINEAR)
    film = MixedFilm(scene=scene, asperities=tips.table(), cells=512, accuracy=1e-9)
    slider = linear_slider(film=tips.touching, rise=1.5e-6, length=20e-3, speed=1.0, viscosity=0.1)
    speed, twice = (SeparationSearch(film=film).lift_off(pressure, 1e-3) for pressure in (1e6, 2e6))
    assert speed == pytest.approx(1e6 * 20e-3 / slider.load, rel=1e-5)
    assert twice == pytest.approx(2 * speed, rel=1e-8)
    result = equilibrium(at_speed(scene, speed), 1e6, resolution=512, tolerance=1e-9)
    assert result.separation == pytest.approx(tips.touching, rel=1e-6)


def test_what_floats_at_rest_and_what_never_lifts(tips):
    fed = tips.scene(PARALLEL, boundary={"inlet": {"pressure": "1 MPa"}})
    film = MixedFilm(scene=fed, asperities=tips.table(), cells=16)
    assert SeparationSearch(film=film).lift_off(1e5, 1.0) == 0
    still = MixedFilm(scene=tips.scene(PARALLEL), asperities=tips.table(), cells=16)
    assert math.isnan(SeparationSearch(film=still).lift_off(1e5, 1.0))


def test_all_is_continuous_through_lift_off(tips):
    scene = tips.scene(WASHER, **FED)
    film = MixedFilm(scene=scene, asperities=tips.table(), cells=32, accuracy=1e-10)
    speed = SeparationSearch(film=film).lift_off(1e6, 0.5)
    slow, fast, faster = (equilibrium(at_speed(scene, speed * (1 + part)), 1e6, resolution=32, tolerance=1e-10) for part in (-1e-6, 1e-6, 1e-3))  # fmt: skip  # noqa: E501
    assert slow.separation < tips.touching < fast.separation
    assert slow.contact_load > 0 == fast.contact_load
    for name in ("separation", "least_gap", "friction", "film_load", "pressure_max", "friction_coefficient"):
        jump = abs(getattr(fast, name) - getattr(slow, name))
        assert jump <= 1e-5 * abs(getattr(fast, name)), name
    assert faster.separation > fast.separation


@pytest.fixture
def swept(tips):
    scene, kept = tips.scene(WASHER, **FED), []
    curves = stribeck(
        scene, [1.0, 0.0, 0.03, 0.3, 3.0, 0.1], [2e6, 0.5e6], resolution=32, tolerance=TOLERANCE, keep=kept.append
    )
    return scene, curves, kept


def test_a_sweep_balances_at_every_point_and_is_in_order(tips, swept):
    _, curves, kept = swept
    assert [curve.pressure for curve in curves] == [0.5e6, 2e6]
    assert len(kept) == 12
    assert {(point.pressure, point.speed) for point in kept} == {
        (c.pressure, p.speed) for c in curves for p in c.points
    }
    for curve in curves:
        assert [point.speed for point in curve.points] == [0.0, 0.03, 0.1, 0.3, 1.0, 3.0]
        separations = [point.separation for point in curve.points]
        assert separations == sorted(separations)
        for point in curve.points:
            assert point.balance <= TOLERANCE
            area = math.pi / 30 * (0.18**2 - 0.15**2)
            assert point.film_load + point.contact_load == pytest.approx(curve.pressure * area, rel=2e-6)
            assert (point.speed < curve.lift_off.speed) == (point.contact_load > 0)
            assert point.contact_share < 1
            assert point.friction_coefficient < tips.friction * 1.001
    assert curves[0].lift_off.speed < curves[1].lift_off.speed


def test_points_do_not_depend_on_those_before_them(swept):
    scene, curves, _ = swept
    for point in (curves[0].points[2], curves[1].points[3]):
        alone = equilibrium(at_speed(scene, point.speed), point.pressure, resolution=32, tolerance=TOLERANCE)
        assert alone.separation == pytest.approx(point.separation, rel=1e-5)
        assert alone.friction == pytest.approx(point.friction, rel=1e-5)


def test_finished_points_are_not_solved_again_and_the_others_are_those_of_a_sweep_that_was_not_stopped(swept):
    scene, curves, kept = swept
    marked = [dataclasses.replace(point, cpu_s=-1.0) for point in kept[:7]]
    new = []
    speeds, pressures = [point.speed for point in curves[0].points], [0.5e6, 2e6]
    again = stribeck(scene, speeds, pressures, resolution=32, tolerance=TOLERANCE, known=marked, keep=new.append)
    assert len(new) == 5
    for curve, before in zip(again, curves, strict=True):
        assert curve.lift_off == before.lift_off
        for point, old in zip(curve.points, before.points, strict=True):
            assert dataclasses.replace(point, cpu_s=0.0) == dataclasses.replace(old, cpu_s=0.0)
    assert sum(point.cpu_s == -1.0 for curve in again for point in curve.points) == 7


def test_a_stored_point_without_uncertainty_is_completed(swept):
    scene, curves, _ = swept
    old = curves[0].points[0]
    bare, new = dataclasses.replace(old, uncertainty={}), []
    again = stribeck(
        scene, [old.speed], [old.pressure], resolution=32, tolerance=TOLERANCE, known=[bare], keep=new.append
    )
    result = again[0].points[0]
    assert new == [result]
    assert result.separation == old.separation
    assert result.uncertainty["separation"] == pytest.approx(old.uncertainty["separation"], rel=1e-3)


def test_the_uncertainty_of_friction_covers_that_of_its_factors(tips):
    def bar(unsure):
        table = tips.table()
        points = [
            dataclasses.replace(
                point, uncertainty=dataclasses.replace(point.uncertainty, couette=unsure / point.mean_gap)
            )
            for point in table.factors.points
        ]
        open_table = AsperityTable(factors=dataclasses.replace(table.factors, points=points))
        return stribeck(tips.scene(LINEAR), [0.2], [2e6], asperities=open_table, resolution=32)[0].points[0]

    exact, unsure = bar(0.0), bar(0.2)
    viscous = exact.friction - 0.1 * exact.contact_load
    assert unsure.uncertainty["friction"] - exact.uncertainty["friction"] == pytest.approx(0.2 * viscous, rel=1e-6)


@pytest.mark.parametrize("speeds", [[0.0], [1e-7], [50.0]])
def test_lift_off_does_not_depend_on_the_requested_speeds(tips, speeds):
    curve = stribeck(tips.scene(LINEAR), speeds, [2e6], resolution=64)[0]
    slider = linear_slider(film=tips.touching, rise=1.5e-6, length=20e-3, speed=1.0, viscosity=0.1)
    assert curve.lift_off.speed == pytest.approx(2e6 * 20e-3 / slider.load, rel=0.01)


def test_uncertainties_cover_finer_grids(tips):
    """On a wedge with a closed form."""
    speeds, pressure = [0.3, 1.0], 2e6
    curve = stribeck(tips.scene(LINEAR), speeds, [pressure], resolution=64)[0]
    slider = linear_slider(film=tips.touching, rise=1.5e-6, length=20e-3, speed=1.0, viscosity=0.1)
    lift = pressure * 20e-3 / slider.load
    assert abs(curve.lift_off.speed - lift) <= curve.lift_off.uncertainty <= 0.01 * lift
    for point in curve.points:
        fine = equilibrium(at_speed(tips.scene(LINEAR), point.speed), pressure, resolution=1024)
        assert point.uncertainty
        for name, unsure in point.uncertainty.items():
            assert abs(getattr(point, name) - getattr(fine, name)) <= unsure + 2e-6 * abs(getattr(fine, name)), name


def test_a_film_given_by_points_has_the_same_curve(tips, tmp_path):
    np.save(tmp_path / "wedge.npy", np.linspace(6e-6, 1e-6, 33)[:, None] * np.ones(3))
    given = {"shape": "given", "length": "20 mm", "width": "20 mm", "film": "1 um", "thickness": str(tmp_path / "wedge.npy")}  # fmt: skip  # noqa: E501
    one, other = (equilibrium(tips.scene(shape), 1e6, resolution=32) for shape in (PAD, given))
    assert other.separation == pytest.approx(one.separation, rel=1e-8)
    assert other.friction == pytest.approx(one.friction, rel=1e-8)


@pytest.mark.parametrize(
    ("speeds", "pressures", "resolution", "words"),
    [
        ([], [1e6], 32, "speeds: are missing"),
        ([-1.0], [1e6], 32, r"speeds: got -1\.0; give finite numbers that are 0 or more"),
        ([math.nan], [1e6], 32, "speeds: got nan"),
        ([1.0, 1.0], [1e6], 32, "speeds: got the same number twice"),
        ([1.0], [0.0], 32, r"loads: got 0\.0; give finite numbers that are above 0"),
        ([1.0], [1e6], 8, "resolution: got 8"),
    ],
)
def test_invalid_speeds_and_loads_are_refused(tips, speeds, pressures, resolution, words):
    with pytest.raises(InputError, match=words):
        stribeck(tips.scene(PAD), speeds, pressures, resolution=resolution)


def test_separations_may_be_negative(tips):
    """A table whose separations go below 0: the walls are in equilibrium there too."""
    table = tips.table()
    points = tuple(
        dataclasses.replace(point, separation=point.separation - 0.5e-6) if point.load else point
        for point in table.factors.points
    )
    crushed = dataclasses.replace(table, factors=dataclasses.replace(table.factors, points=points))
    assert crushed.closest < 0
    film = MixedFilm(scene=tips.scene(PARALLEL), asperities=crushed, cells=16)
    pressure = 0.999 * crushed.largest_pressure
    result = balanced(FilmsAtSpeed(film=film, speed=0.0), pressure, tolerance=1e-9)
    assert result.scene.geometry.film == pytest.approx(crushed.separation_at(pressure), rel=1e-6)
    assert result.scene.geometry.film < 0
