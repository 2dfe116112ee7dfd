"""Grooves whose film ruptures: closed form, quadrature, the bearing of the same walls, conservation of mass."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from roughfilm.ladder import find
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

LENGTH, FILM, ETA, SPEED, AMBIENT = 2e-3, 20e-6, 0.02, 50.0, 101325.0
ARC = {"width": "0.8 mm", "depth": "15 um"}
SPLINE = {"profile": "splined", "width": "0.9 mm", "depth": "12 um", "shift": "0.2 mm", "position": "-0.3 mm"}
BOX = {
    "profile": "points",
    "position": "-0.5 mm",
    "points": [[-0.3e-3, 0.0], [-0.3e-3 + 1e-9, 1e-5], [0.3e-3 - 1e-9, 1e-5], [0.3e-3, 0.0]],
}


def scene_of(groove, *, speed=SPEED, ambient=AMBIENT):
    return read_scene(
        {
            "name": "ruptured",
            "kind": "pocket",
            "geometry": {"length": f"{LENGTH!r} m", "film": f"{FILM!r} m", **groove},
            "lubricant": {"viscosity": f"{ETA!r} Pa*s", "density": "870 kg/m^3"},
            "motion": {"speed": f"{speed!r} m/s"},
            "boundary": {"ambient_pressure": f"{ambient!r} Pa"},
        }
    )


def solved(scene, cells=1024):
    return find("pocket", "reynolds_cavitating").solve(scene, Request(resolution=cells))


def by_quadrature(scene):
    """Load above ambient, N/m, where the film ruptures and reforms, m, and the flow, m²/s, after Jakobsson and Floberg.

    The film ruptures where p is the cavitation pressure and its gradient 0, thus u h/2 = q, and reforms where the
    pressure of the same flow, integrated back from the end of the period, falls to the cavitation pressure.
    """
    gap, half, ambient = scene.gap(), LENGTH / 2, scene.boundary.ambient_pressure
    breaks = np.array(gap.breaks)
    x = np.linspace(-half, half, 20001)
    deepest = x[np.argmax(gap.thickness(x))]

    def thickness(x):
        return float(gap.thickness(np.array([x]))[0])

    def gradient(x, q):
        return 12 * ETA * (SPEED / 2 * thickness(x) - q) / thickness(x) ** 3

    def rise(a, b, q, moment=lambda x: 1.0):
        inside = breaks[(breaks > a) & (breaks < b)]
        return quad(lambda x: moment(x) * gradient(x, q), a, b, points=inside, epsabs=0, epsrel=1e-12)[0]

    def at_rupture(place):
        return ambient + rise(-half, place, SPEED / 2 * thickness(place))

    ruptures = brentq(at_rupture, breaks[1], deepest, xtol=1e-14)
    q = SPEED / 2 * thickness(ruptures)
    reforms = brentq(lambda place: ambient - rise(place, half, q), ruptures + 1e-9, breaks[-2], xtol=1e-14)
    before = ambient * (ruptures + half) + rise(-half, ruptures, q, lambda x: ruptures - x)
    behind = rise(reforms, half, q, lambda x: half - x)
    return before + behind - ambient * LENGTH, ruptures, reforms, q


@pytest.fixture(scope="module", params=[ARC, SPLINE], ids=["arc", "spline"])
def ruptured(request):
    scene = scene_of(request.param)
    return scene, solved(scene)


def test_load_and_cavity_are_those_of_quadrature_between_rupture_and_reformation(ruptured):
    scene, result = ruptured
    load, begins, ends, _ = by_quadrature(scene)
    assert result["load"].value == pytest.approx(load / LENGTH, abs=result["load"].uncertainty)
    assert result["load"].value == pytest.approx(load / LENGTH, rel=2e-4)
    fraction = result["cavitated_fraction"]
    assert fraction.value == pytest.approx((ends - begins) / LENGTH, abs=max(fraction.uncertainty, 1 / 1024))


def test_mass_passes_the_film_and_its_cavity_alike(ruptured):
    """In the cavity u θ h/2, in the film u h/2 - h³/(12η) dp/dx; both are the flow of quadrature."""
    scene, result = ruptured
    x, h, p, theta = (
        result.fields[name].values for name in ("position", "film_thickness", "pressure", "density_ratio")
    )
    q, cavity = by_quadrature(scene)[3], theta < 1 - 1e-9
    assert cavity.sum() > 100
    assert (p[cavity] == scene.cavitation_pressure).all()
    assert SPEED / 2 * (theta * h)[cavity][1:-1] == pytest.approx(q, rel=1e-4)
    middle, slope = scene.gap().thickness((x[1:] + x[:-1]) / 2), np.diff(p) / np.diff(x)
    film = ~(cavity[1:] | cavity[:-1])
    assert SPEED / 2 * middle[film][3:-3] - (middle**3 * slope)[film][3:-3] / (12 * ETA) == pytest.approx(q, rel=2e-3)


def test_a_box_has_the_closed_form_of_a_pocket_that_cavitates_at_its_upstream_edge():
    """Fowell et al. 2007, doi:10.1115/1.2540089, for parallel walls: every pressure is linear."""
    scene = scene_of(BOX)
    inlet, pocket, outlet = 0.2e-3, 0.6e-3, 1.2e-3
    deep = FILM + 1e-5
    q = SPEED * FILM / 2 * (1 + AMBIENT * FILM**2 / (6 * ETA * SPEED * inlet))  # the inlet land falls to vacuum
    top = AMBIENT + AMBIENT * outlet / inlet  # absolute pressure at the end of the pocket
    slope = 12 * ETA / deep**3 * (SPEED * deep / 2 - q)
    reformed = top / slope
    assert reformed < pocket
    load = inlet * AMBIENT / 2 + reformed * top / 2 + outlet * (top + AMBIENT) / 2 - AMBIENT * LENGTH
    result = solved(scene)
    assert result["load"].value == pytest.approx(load / LENGTH, rel=1e-3)
    assert result["pressure_max_plus"].value * scene.pressure_unit / scene.plus_factor == pytest.approx(
        top - AMBIENT, rel=1e-3
    )
    assert result["cavitated_fraction"].value == pytest.approx((pocket - reformed) / LENGTH, abs=1 / 1024)
    assert result["theta_min"].value == pytest.approx(2 * q / (SPEED * deep), rel=1e-3)


def test_the_bearing_of_the_same_walls_has_the_same_film():
    pad = read_scene(
        {
            "name": "pad",
            "kind": "bearing",
            "geometry": {
                "shape": "parallel",
                "length": f"{LENGTH!r} m",
                "film": f"{FILM!r} m",
                "texture": {"profile": "box", "length": "0.6 mm", "depth": "10 um", "start": "0.2 mm"},
            },
            "lubricant": {"viscosity": f"{ETA!r} Pa*s", "cavitation_pressure": f"{-AMBIENT!r} Pa"},
            "motion": {"speed": f"{SPEED!r} m/s"},
            "boundary": {"inlet": {"pressure": "0 Pa"}, "outlet": {"pressure": "0 Pa"}},
        }
    )
    bearing = find("bearing", "reynolds_incompressible").solve(pad, Request(resolution=1024))
    pocket = solved(scene_of(BOX))
    for ours, theirs in (("load_per_area", "load_per_width"), ("friction_per_area", "friction_per_width")):
        assert pocket[ours].value == pytest.approx(bearing[theirs].value / LENGTH, rel=1e-4)
    for name in ("cavitated_fraction", "theta_min"):
        assert pocket[name].value == pytest.approx(bearing[name].value, rel=2e-3)


@pytest.mark.parametrize("groove", [ARC, SPLINE, BOX], ids=["arc", "spline", "box"])
def test_a_film_that_stays_whole_is_that_of_the_reynolds_equation(groove):
    scene = scene_of(groove, ambient=2e6)
    cavitating, reynolds = solved(scene), find("pocket", "reynolds").solve(scene)
    assert reynolds.fields["pressure"].values.min() > scene.cavitation_pressure
    assert cavitating["cavitated_fraction"].value == 0
    for name, exact in reynolds.quantities.items():
        own = cavitating[name]
        assert own.value == pytest.approx(exact.value, rel=1e-4, abs=own.uncertainty + 1e-3 * scene.plus_factor)
    x, p = (cavitating.fields[name].values for name in ("position", "pressure"))
    other = np.interp(x, *(reynolds.fields[name].values for name in ("position", "pressure")))
    assert np.abs(p - other).max() < 0.02 * np.abs(p).max()


def test_load_is_second_order_accurate_and_its_uncertainty_covers_the_error(ruptured):
    scene, _ = ruptured
    load = by_quadrature(scene)[0] / LENGTH
    runs = [solved(scene, cells)["load"] for cells in (96, 192, 384, 768)]
    errors = [abs(run.value - load) for run in runs]
    assert all(error <= run.uncertainty for error, run in zip(errors, runs, strict=True))
    assert np.polyfit(np.log([96, 192, 384, 768]), np.log(errors), 1)[0] < -1.4


def test_parallel_walls_without_suction_carry_nothing():
    """At a cavitation pressure equal to ambient the film of a groove is nowhere above it: the ends are full, p = 0."""
    entries = scene_of(ARC).model_dump(mode="json", exclude_none=True)
    entries["lubricant"]["cavitation_pressure"] = "0 Pa"
    scene = read_scene(entries)
    result = solved(scene)
    assert result["load"].value == 0
    assert result["theta_min"].value == pytest.approx(20 / 35, rel=1e-4)
    assert any("lubricant.cavitation_pressure: is ambient pressure" in warning for warning in result.warnings)
