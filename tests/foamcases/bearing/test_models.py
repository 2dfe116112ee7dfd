"""Pads in OpenFOAM: exact flows, closed forms of thin films, an independent model of inertia, and balances."""

import numpy as np
import pytest

from roughfilm.foamcases.bearing.models.navier_stokes import MODEL as NAVIER_STOKES
from roughfilm.foamcases.bearing.models.stokes import MODEL as STOKES
from roughfilm.ladder import find
from roughfilm.rom.bearing.closed_forms.sliding import linear_slider, rayleigh_step
from roughfilm.rom.ladder.request import Request

pytestmark = pytest.mark.openfoam

NO_RUPTURE = {"cavitation_pressure": "-100 MPa"}
POCKETS = {"length": "0.3 mm", "depth": "15 um", "start": "0.1 mm", "pitch": "0.4 mm", "columns": 2}
LENGTH, FILM, VISCOSITY, SPEED = 1e-3, 3e-5, 0.01, 5.0


def values(result, *names):
    return np.array([result.quantities[name].value for name in names])


@pytest.mark.parametrize("sliding", [5.0, -5.0])
def test_a_parallel_film_between_two_pressures_is_exact(pad, sliding):
    """Shear and a parabola; N layers make the flow of a parabola too large by 2/N² exactly."""
    result = NAVIER_STOKES.solve(pad(f"{sliding} m/s", inlet={"pressure": "20 kPa"}), Request(resolution=30))
    driven = FILM**3 * 2e4 / (12 * VISCOSITY * LENGTH) * (1 + 2 / 6**2)
    load, flow, friction = values(result, "load_per_width", "inlet_flow_per_width", "friction_per_width")
    assert load == pytest.approx(2e4 * LENGTH / 2, rel=1e-6)
    assert friction == pytest.approx(VISCOSITY * SPEED * LENGTH / FILM - FILM / 2 * 2e4, rel=1e-6)
    assert flow == pytest.approx(SPEED * FILM / 2 + driven, rel=1e-6)
    assert result.numerics.details["force_imbalance"] < 1e-5


def test_stokes_flow_in_a_wedge_becomes_that_of_reynolds_at_second_order_in_the_slope(pad):
    differences = []
    for film in (1e-4, 5e-5):
        scene = pad(shape="linear", film=f"{film} m", rise=f"{film} m")
        coarse, fine = (values(STOKES.solve(scene, Request(resolution=n)), "load_per_width")[0] for n in (60, 120))
        exact = linear_slider(film=film, rise=film, length=LENGTH, speed=SPEED, viscosity=VISCOSITY).load
        differences.append((fine + (fine - coarse) / 3) / exact - 1)
    assert differences[0] == pytest.approx(0.0125, abs=1e-3)
    assert np.log2(differences[0] / differences[1]) == pytest.approx(2, abs=0.2)


def test_stokes_flow_over_a_step_in_a_thin_film_is_that_of_rayleigh(pad):
    sizes = {"film": 1e-5, "rise": 1e-5, "step": 0.7 * LENGTH}
    scene = pad(shape="step", lubricant=NO_RUPTURE, **{name: f"{size} m" for name, size in sizes.items()})
    result = STOKES.solve(scene, Request(resolution=80))
    exact = rayleigh_step(**sizes, length=LENGTH, speed=SPEED, viscosity=VISCOSITY)
    names = "load_per_width", "pressure_max", "friction_per_width"
    assert values(result, *names) == pytest.approx([exact.load, exact.pressure_max, exact.friction], rel=0.01)
    assert result.numerics.details["mass_imbalance"] < 1e-6
    assert result.numerics.details["force_imbalance"] < 5e-3


@pytest.fixture(scope="module")
def textured(pad):
    """A textured pad with inertia, Re = 60, on two grids by Navier-Stokes, and by the thin film with slope."""
    scene = pad("20 m/s", texture=POCKETS, lubricant=NO_RUPTURE)
    results = [NAVIER_STOKES.solve(scene, Request(resolution=n)) for n in (60, 120)]
    return scene, results, find("bearing", "film_slope").solve(scene)


def test_the_load_of_a_textured_pad_with_inertia_is_that_of_the_thin_film_with_slope(textured):
    scene, (coarse, fine), film = textured
    names = "load_per_width", "friction_per_width", "inlet_flow_per_width"
    extrapolated = values(fine, *names) + (values(fine, *names) - values(coarse, *names)) / 3
    assert values(film, *names) == pytest.approx(extrapolated, rel=0.01)
    without = find("bearing", "reynolds").solve(scene)
    assert values(fine, "load_per_width")[0] > 1.1 * values(without, "load_per_width")[0]


def test_flow_and_force_balance_and_the_error_of_the_forces_falls_with_the_cells(textured):
    _, results, _ = textured
    for result in results:
        assert result.numerics.details["mass_imbalance"] < 1e-6
        assert result.numerics.details["force_imbalance"] < 1e-3
        assert result.numerics.residual < 2e-7


def test_fields_are_those_of_a_bearing_and_of_its_cells(textured):
    scene, (result, _), _ = textured
    fields = {name: field.values for name, field in result.fields.items()}
    columns = fields["x"].shape[0]
    assert fields["cell_velocity"].shape == (columns, 12, 2)
    assert fields["vertices"].shape == (columns + 1, 13, 2)
    assert fields["film_thickness"].max() == pytest.approx(FILM + 15e-6, rel=1e-2)
    widths = np.diff(fields["vertices"][:, -1, 0])
    for field, name in (("pressure", "load_per_width"), ("shear_stress", "friction_per_width")):
        assert fields[field][:, 0] @ widths == pytest.approx(values(result, name)[0])
    assert scene.motion.speed == pytest.approx(fields["cell_velocity"][..., 0].max(), rel=0.1)


def test_a_wall_that_slides_backwards_has_the_mirrored_flow_of_its_mirrored_pad(pad):
    """Pockets near the end are pockets near the inlet of the other motion; boxes have a mesh with steps."""
    boxes = {"profile": "box", "length": "0.2 mm", "depth": "20 um"}
    ahead, behind = (
        NAVIER_STOKES.solve(pad(speed, texture={**boxes, "start": start}, lubricant=NO_RUPTURE), Request(resolution=40))
        for speed, start in (("5 m/s", "0.1 mm"), ("-5 m/s", "0.7 mm"))
    )
    names = "load_per_width", "friction_per_width", "inlet_flow_per_width", "pressure_max"
    assert values(behind, *names) == pytest.approx(values(ahead, *names), rel=1e-9)
    mirrored = {name: field.values[::-1] for name, field in behind.fields.items()}
    assert mirrored["pressure"] == pytest.approx(ahead.fields["pressure"].values)
    assert -mirrored["cell_velocity"][..., 0] == pytest.approx(ahead.fields["cell_velocity"].values[..., 0])
    assert np.array_equal(mirrored["kept"], ahead.fields["kept"].values)
    assert LENGTH - mirrored["vertices"][..., 0] == pytest.approx(ahead.fields["vertices"].values[..., 0])


def test_pressures_below_cavitation_pressure_are_a_warning(pad):
    scene = pad("5 m/s", texture=POCKETS)
    (warning,) = STOKES.solve(scene, Request(resolution=30)).warnings
    assert "below the cavitation pressure: the film ruptures, which this model leaves out" in warning


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"width": "1 mm"}, "infinitely wide pads only"),
        (
            {
                "lubricant": {
                    "density": "1000 kg/m^3",
                    "piezoviscosity": {"law": "barus", "pressure_coefficient": "20 GPa^-1"},
                }
            },
            "the viscosity changes",
        ),
        ({"inlet": {"theta": 0.5}}, "the inlet is starved"),
    ],
)
def test_other_scenes_are_refused_with_a_reason(pad, changes, words):
    for model in (STOKES, NAVIER_STOKES):
        fits = model.applies(pad(**changes))
        assert not fits.applies
        assert words in fits.reason


def test_a_pad_of_flat_cells_is_that_of_reynolds(pad):
    """A wedge of 0.5 µm over 10 mm, whose cells are longer than 1000 times their thickness."""
    sizes = {"film": 5e-7, "rise": 5e-7, "length": 1e-2}
    scene = pad("1 m/s", shape="linear", lubricant=NO_RUPTURE, **{name: f"{size} m" for name, size in sizes.items()})
    coarse, fine = (NAVIER_STOKES.solve(scene, Request(resolution=n)) for n in (60, 120))
    names = "load_per_width", "friction_per_width"
    extrapolated = values(fine, *names) + (values(fine, *names) - values(coarse, *names)) / 3
    exact = linear_slider(**sizes, speed=1.0, viscosity=VISCOSITY)
    assert extrapolated == pytest.approx([exact.load, exact.friction], rel=1e-3)
    assert fine.numerics.details["mass_imbalance"] < 1e-6
