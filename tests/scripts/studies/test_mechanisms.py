"""Inertia beside cavitation: what must come out of two gaps that carry nothing by the Reynolds equation."""

import pytest

from scripts.studies.mechanisms import data as mechanisms


@pytest.mark.parametrize("gap", mechanisms.GAPS)
def test_neither_gap_carries_load_by_the_reynolds_equation(gap):
    pocket = mechanisms.solve(mechanisms.pocket(gap, 5.0), "reynolds")
    assert mechanisms.periodic_pressure(gap, pocket)[1].mean() == pytest.approx(0, abs=1e-3 * 7e3)
    slider = mechanisms.solve(mechanisms.slider(gap, 5.0, 1e5), "reynolds")
    assert slider.quantities["load_per_width"].value == pytest.approx(0, abs=1e-6)


@pytest.mark.parametrize("gap", mechanisms.GAPS)
def test_pocket_and_slider_are_the_same_gap(gap):
    pocket = mechanisms.solve(mechanisms.pocket(gap, 5.0), "reynolds").quantities
    slider = mechanisms.solve(mechanisms.slider(gap, 5.0, 1e6), "reynolds_cavitating").quantities
    swing = pocket["pressure_max_plus"].value - pocket["pressure_min_plus"].value
    scene = mechanisms.pocket(gap, 5.0)
    # a symmetric gap swings as far up as down about its ends; the arc and the parabola differ by 1 %
    assert slider["pressure_max"].value == pytest.approx(swing / 2 * scene.pressure_unit / scene.plus_factor, rel=0.012)
    assert slider["cavitated_fraction"].value == 0


def test_waves_and_groove_are_opposites():
    assert mechanisms.by_cavitation("waves", 5.0, 0.0) > 1000
    assert mechanisms.by_inertia("waves", 5.0) < -100
    assert mechanisms.by_inertia("groove", 5.0) > 100
    assert mechanisms.by_cavitation("groove", 30.0, 20e3) < -1000


def test_a_film_that_tears_at_ambient_carries_in_proportion_to_speed():
    slow, fast = (mechanisms.by_cavitation("waves", speed, 0.0) for speed in (1.0, 10.0))
    assert fast == pytest.approx(10 * slow, rel=1e-6)


def test_loads_depend_on_one_number_each():
    # double the speed and halve the viscosity: the same ηu, hence the same cavitation; here by the tension instead
    one, other = (mechanisms.by_cavitation("waves", speed, 2e3 * speed) for speed in (2.0, 8.0))
    assert other == pytest.approx(4 * one, rel=1e-6)
    first, second = (mechanisms.by_inertia("groove", speed) for speed in (0.5, 1.0))
    assert second == pytest.approx(4 * first, rel=0.02)
