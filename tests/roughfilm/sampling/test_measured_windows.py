"""Windows of measured surfaces: those along a lay count less, and two sets of one surface agree."""

import pytest

import roughfilm as rf
from roughfilm.contact.preparation.recipe import load_recipe
from roughfilm.sampling.plan import planned

pytestmark = pytest.mark.measured


def plan_of(path, **options):
    surface = rf.read_surface(path)
    return planned(surface, load_recipe(), sizes=[], name=path.name, progress=lambda *_: None, **options)


def test_windows_of_striations_count_once_along_them(measured_file):
    """The striations of ground_striated.x3p run along y: two columns of four windows are worth about two."""
    plan = plan_of(measured_file("ground_striated.x3p"), count=8, size=4e-5)
    (group,) = plan.groups
    assert len({window.start[0] for window in group.windows}) == 2
    assert group.independent < 5
    polished = plan_of(measured_file("polished.opd"), count=8, size=3e-5)
    assert polished.groups[0].independent > 7


def test_half_of_the_windows_predicts_the_rms_height_of_the_others(measured_file):
    found = rf.windows(measured_file("polished.opd"), count=16, size=2e-5, sizes=[])
    values = found.quantities["Sq"].scatter.values
    low, high = found.quantities["Sq"].scatter.interval
    assert ((values >= low) & (values <= high)).mean() >= 0.85
