"""Powers that were put in are found again, and thresholds mean what they say."""

import numpy as np
import pytest

from roughfilm.ladder import find
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.pocket.error_law import ErrorLaw, product_text
from roughfilm.rom.pocket.models import film, inertial_reynolds
from roughfilm.rom.studies.ordering import CERTAINTY, fitted_powers, ordering, threshold

RANDOM = np.random.default_rng(1828067)


@pytest.fixture
def features():
    return {name: np.exp(RANDOM.uniform(-2, 2, 400)) for name in ("reynolds_number", "depth", "slope")}


def test_the_powers_of_an_exact_law_are_found(features):
    error = 0.01 * features["reynolds_number"] ** 1.5 * features["slope"] ** 0.75
    powers = fitted_powers(features, error, step=0.25)
    assert powers == {"reynolds_number": 1.0, "slope": 0.5}


def test_noise_does_not_move_them(features):
    noise = np.exp(RANDOM.normal(0, 0.3, 400))
    error = 0.02 * features["depth"] ** 2 / features["slope"] * noise
    powers = fitted_powers(features, error, step=0.25)
    assert powers == {"depth": 1.0, "slope": -0.5}
    found = ordering(features, powers, error, (0.01,))
    wrong = ordering(features, {"reynolds_number": 1.0}, error, (0.01,))
    assert found.rank > 0.95 > 0.3 > abs(wrong.rank)


def test_a_threshold_is_the_last_number_up_to_which_nearly_all_keep_the_tolerance():
    number = np.arange(1.0, 101.0)
    error = np.where(number <= 60, 0.01, 0.5)
    error[10] = 0.5
    last = threshold(number, error, 0.05)
    kept = [np.mean(error[:n] <= 0.05) for n in range(1, 101)]
    assert last == max(n for n, part in enumerate(kept, 1) if part >= CERTAINTY)
    assert 60 < last < 64
    assert threshold(number, error, 0.001) is None


def test_a_law_says_which_tolerance_a_scene_keeps(make_scene):
    law = ErrorLaw(powers={"reynolds_number": 1, "aspect": 1}, thresholds={0.01: 2.0, 0.1: 20.0})
    shallow, deep, far = make_scene(0.3, 0.25, 20), make_scene(0.3, 0.25, 160), make_scene(0.3, 1.25, 160)
    assert law.number(shallow) == pytest.approx(20 * 2 * 7.5e-6 / 0.3e-3)
    assert [law.within(scene) for scene in (shallow, deep, far)] == [0.01, 0.1, None]
    assert "Re · 2d/w = 1: load within 1% up to 2" in law.described(shallow)
    assert "load error above 10% where this is above 20" in law.described(far)


def test_products_are_written_as_people_write_them():
    assert product_text({"reynolds_number": 1, "aspect": 1}) == "Re · 2d/w"
    assert product_text({"reynolds_number": 1, "depth": -1, "aspect": 1}) == "Re · 2Ly/w"
    assert product_text({"depth": 0.75, "slope": -2}) == "(d/Ly)^0.75 · slope^-2"


@pytest.mark.parametrize(("name", "law"), [("inertial_reynolds", inertial_reynolds.LAW), ("film", film.LAW)])
def test_shipped_laws_hold_on_grooves_they_were_not_fitted_to(make_scene, name, law):
    """Against film_slope, whose own load is within 1 % of Navier-Stokes there."""
    model, reference = (find("pocket", one) for one in (name, "film_slope"))
    kept = []
    random = np.random.default_rng(20081113)
    for _ in range(60):
        width, depth = random.uniform(0.16, 0.49), random.uniform(0.26, 1.0)
        scene = make_scene(width, depth, random.uniform(10, 160))
        within = law.within(scene)
        if within is None or scene.slope > 0.46:
            continue
        exact, load = (
            m.solve(scene, Request(resolution=200 if m.order else None)).quantities["load_plus"].value
            for m in (reference, model)
        )
        kept.append(abs(load - exact) <= (within + 0.01) * abs(exact))
    assert len(kept) >= 8
    assert np.mean(kept) >= 0.9


@pytest.mark.parametrize(("width", "depth"), [(0.149, 0.25), (0.16, 1.4)])
def test_of_grooves_beyond_those_compared_no_law_tells(make_scene, width, depth):
    """Narrower than five film thicknesses, or deeper than a quarter of their width: of such loads nothing is known."""
    law = ErrorLaw(powers={"slope": 1}, thresholds={0.05: 1.25})
    assert law.within(make_scene(0.16, 1.3, 20)) == 0.05
    scene = make_scene(width, depth, 20)
    assert law.within(scene) is None
    assert "loads were compared for grooves" in law.described(scene)
    assert "loads were compared" in find("pocket", "film_slope").solve(scene, Request(resolution=50)).warnings[0]
