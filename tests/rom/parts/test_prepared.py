"""The error of a contact by the preparation of its surface: stated where it changes it, unknown where in doubt."""

import math

import numpy as np
import pytest

from roughfilm.contact.preparation.prepare import prepare
from roughfilm.contact.preparation.recipe import AS_IT_IS, read_recipe
from roughfilm.contact.surfaces.store import save_surface
from roughfilm.contact.synthetic.description import make, read_entries
from roughfilm.interface.solving import solve
from roughfilm.rom.ladder.scene import read_scene

ROUGH = {
    "kind": "self_affine",
    "size": ["48 um", "48 um"],
    "points": [48, 48],
    "seed": 3,
    "hurst": 0.8,
    "roll_off": "16 um",
    "cut_off": "6 um",
    "rms_height": "0.1 um",
}
SOLID = {"modulus": "210 GPa", "poisson": 0.3}
LOAD = {"pressure": "100 MPa"}
SEAL = {
    "liquid": {"density": "1000 kg/m^3", "viscosity": "1 mPa*s"},
    "flow": {"pressure_drop": "1 MPa", "length": "0.2 mm", "direction": "x"},
}


def contact(surface, folder, kind="dry_contact", **more):
    save_surface(surface, folder / "s.h5", overwrite=True)
    entries = {"name": "p", "kind": kind, "geometry": {"surface": str(folder / "s.h5")}, "solid": SOLID, "load": LOAD}
    return solve(read_scene({**entries, **more}), model={"dry_contact": "elastic", "seal": "direct_leakage"}[kind])


@pytest.fixture(scope="module")
def complete():
    return make(read_entries(ROUGH))


def prepared(surface, **recipe):
    return prepare(surface, read_recipe({**AS_IT_IS, **recipe})).surface


def test_a_surface_as_it_is_has_no_error_by_its_preparation(complete, tmp_path):
    plain, same = contact(complete, tmp_path), contact(prepared(complete), tmp_path)
    assert same.expected_error == pytest.approx(plain.expected_error)


@pytest.mark.parametrize("kind", ["dry_contact", "seal"])
def test_smoothing_and_holes_are_within_the_stated_error(complete, tmp_path, kind):
    """The truth is the contact of the complete surface, without holes and smoothing."""
    more = SEAL if kind == "seal" else {}
    x, y = np.ogrid[:48, :48]
    invalid = (x - 20) ** 2 + (y - 28) ** 2 < 150
    holed = complete.with_heights(np.where(invalid, 0.0, complete.heights), invalid=invalid, periodic=True)
    true = contact(complete, tmp_path, kind, **more)
    for recipe in ({"smoothing": 3}, {}):
        found = contact(prepared(holed, **recipe), tmp_path, kind, **more)
        for name in ("area_fraction", "mean_gap"):
            error = abs(found[name].value / true[name].value - 1)
            assert true.expected_error[name] < found.expected_error[name]
            assert error < found.expected_error[name]
        assert "estimated from the preparation of the surface" in str(found.provenance["errors"])


def test_spots_that_may_be_a_texture_leave_the_error_unknown_and_are_said_in_every_result(complete, tmp_path):
    bumps = np.zeros(complete.shape)
    bumps[6::12, 6::12] = 2e-6
    textured = complete.with_heights(complete.heights + bumps, periodic=False)
    assert math.isclose(bumps.max(), 20 * complete.heights.std(), rel_tol=0.1)
    found = contact(prepared(textured, outliers={"limit": 4.0}), tmp_path)
    assert not found.expected_error
    assert any("when it was prepared" in one and "alike" in one for one in found.warnings)
