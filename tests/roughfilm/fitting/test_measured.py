"""Descriptions fitted to measured surfaces: what they hold, and what they name where they fail."""

import pytest

from roughfilm.contact.preparation.recipe import read_recipe
from roughfilm.contact.surfaces.files import read_surface
from roughfilm.fitting.run import fit_windows

pytestmark = pytest.mark.measured


def fitted(path, *, count=32, points=48):
    recipe = read_recipe({"grid": {"points": [points, points]}})
    return fit_windows(read_surface(path), recipe, count=count, seeds=60, progress=lambda *_: None)


def test_seeds_hold_the_windows_of_a_polished_surface(measured_file):
    fit = fitted(measured_file("polished.opd"))
    assert min(one.inside for one in fit.held.values()) >= 25  # of 32 at 95 %: fewer in one of 2000 samples
    assert not any(one.fails for one in fit.held.values())


def test_periodic_grooves_are_named_where_seeds_fail(measured_file):
    fit = fitted(measured_file("periodic_grooves.plu"), count=48, points=64)
    assert fit.held["contact pressure"].fails
    (grooves,) = (one for one in fit.findings if one.name == "grooves")
    wavelength = float(grooves.text.partition("waves of ")[2].partition(" µm")[0])
    assert wavelength == pytest.approx(15.0, rel=0.25)  # that of a whole number of waves in the window
    (warning,) = (one for one in fit.warnings if "contact pressure" in one)
    assert "periodic grooves" in warning
