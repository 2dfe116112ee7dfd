"""A description fitted to a measured surface names the reason where its seeds do not scatter as the windows do."""

import pytest

from roughfilm.contact.preparation.recipe import read_recipe
from roughfilm.contact.surfaces.files import read_surface
from roughfilm.fitting.run import fit_windows

pytestmark = pytest.mark.measured


def test_periodic_grooves_are_named_where_seeds_fail(measured_file):
    measured = read_surface(measured_file("periodic_grooves.plu"))
    recipe = read_recipe({"grid": {"points": [64, 64]}, "outliers": {"quantile": 0.002}})
    fit = fit_windows(measured, recipe, count=48, seeds=60, progress=lambda *_: None)
    assert fit.held["contact pressure"].fails
    (grooves,) = (one for one in fit.findings if one.name == "grooves")
    wavelength = float(grooves.text.partition("waves of ")[2].partition(" µm")[0])
    assert wavelength == pytest.approx(15.0, rel=0.25)  # that of a whole number of waves in the window
    (warning,) = (one for one in fit.warnings if "contact pressure" in one)
    assert "periodic grooves" in warning
