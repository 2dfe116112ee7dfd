"""Form removal takes exactly the polynomial it names, by the valid points alone."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.preparation.form import remove_form
from roughfilm.contact.preparation.prepare import prepare
from roughfilm.contact.preparation.recipe import Recipe
from roughfilm.contact.surfaces.surface import Surface

NX, NY = 37, 24
X, Y = np.meshgrid(np.arange(NX) * 2.0e-6, np.arange(NY) * 0.7e-6, indexing="ij")
FORMS = {
    "mean": 3e-6 + 0 * X,
    "tilt": 1e-6 + 0.02 * X - 0.3 * Y,
    "quadratic": 0.01 * X + 0.1 * Y + 300 * X**2 - 200 * X * Y + 5000 * Y**2,
    "quartic": 0.01 * X + 300 * X**2 - 2e6 * X * Y**2 + 4e10 * X**2 * Y**2 - 9e9 * X**4,
    "sextic": 0.1 * Y + 4e10 * X**2 * Y**2 + 3e18 * X**6 - 5e18 * X**2 * Y**4,
}


def surface(heights, invalid=None):
    return Surface(
        heights=heights, spacing=(2.0e-6, 0.7e-6), invalid=np.zeros((NX, NY), bool) if invalid is None else invalid
    )


@pytest.mark.parametrize("form", FORMS)
def test_a_form_of_that_order_vanishes_by_the_valid_points_alone(form):
    invalid = np.random.default_rng(811).random((NX, NY)) < 0.4
    heights = np.where(invalid, 1e3, FORMS[form])
    left = remove_form(surface(heights, invalid), form)
    assert np.abs(left.heights[left.valid]).max() < 1e-12 * np.abs(FORMS[form]).max()


def test_what_is_left_is_orthogonal_to_the_form_that_was_taken():
    rng = np.random.default_rng(812)
    invalid = rng.random((NX, NY)) < 0.2
    left = remove_form(surface(rng.normal(size=(NX, NY)), invalid), "quadratic")
    z, valid = left.heights, left.valid
    for term in (1 + 0 * X, X, Y, X**2, X * Y, Y**2):
        assert abs(np.sum((z * term)[valid])) < 1e-11 * np.sum(np.abs(term[valid]))


def test_heights_on_a_high_pedestal_keep_their_digits():
    rough = np.random.default_rng(813).normal(size=(NX, NY)) * 1e-9
    plain, lifted = (remove_form(surface(rough + level), "quadratic").heights for level in (0.0, 1e-2))
    assert np.abs(plain - lifted).max() < 1e-2 * 4e-16 * 10


def test_none_leaves_the_surface_as_it_is():
    given = surface(FORMS["tilt"])
    assert remove_form(given, "none") is given


def test_only_a_form_that_repeats_itself_leaves_a_surface_periodic():
    given = surface(FORMS["tilt"]).with_heights(FORMS["tilt"], periodic=True)
    assert [remove_form(given, form).periodic for form in ("none", "mean", "tilt", "quadratic")] == [
        True,
        True,
        False,
        False,
    ]


def test_points_on_one_line_do_not_determine_a_tilt():
    invalid = np.ones((NX, NY), bool)
    invalid[:, 5] = False
    with pytest.raises(InputError, match=r"^form: the valid points do not determine a form 'tilt'; choose"):
        remove_form(surface(FORMS["tilt"], invalid), "tilt")


@pytest.mark.parametrize(
    "heights",
    [np.full((16, 16), 1e-6), np.add.outer(3e-7 * np.arange(20.0), 1e-7 * np.arange(12.0)), np.eye(3) * 1e-7],
)
def test_what_rounding_leaves_of_a_constant_or_tilted_surface_is_no_roughness_and_no_wrong_unit(heights):
    with pytest.raises(InputError, match=r"all heights are the same once its form is removed"):
        prepare(Surface(heights=heights, spacing=(1e-6, 1e-6)), Recipe())
