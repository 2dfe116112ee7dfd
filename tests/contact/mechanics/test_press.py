"""The contact solver against closed forms, and what must hold for any surface and load."""

import math
import tracemalloc

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.mechanics.exact.egg_box import EggBox
from roughfilm.contact.mechanics.exact.hertz import HertzCylinder, HertzSphere
from roughfilm.contact.mechanics.exact.westergaard import Westergaard
from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.synthetic.self_affine import self_affine

MODULUS = 230e9
SIDE = 1e-3


def rough(n, seed=20071, ny=None):
    return self_affine(
        size=(SIDE, SIDE),
        points=(n, ny or n),
        seed=seed,
        hurst=0.8,
        roll_off=SIDE / 4,
        cut_off=8 * SIDE / min(n, ny or n),
        rms_slope=0.1,
    ).heights


def violation(contact, modulus):
    """The conditions of contact by a textbook transform, in double precision, over the rms height."""
    nx, ny = contact.heights.shape
    q = (
        2
        * np.pi
        * np.hypot(np.fft.fftfreq(nx, contact.spacing[0])[:, None], np.fft.fftfreq(ny, contact.spacing[1])[None, :])
    )
    q[0, 0] = np.inf
    gap = np.fft.ifft2(np.fft.fft2(contact.pressure) * 2 / (modulus * q)).real - contact.heights
    p = contact.pressure
    inside = (p > 0) & (p < contact.hardness)
    off, plastic = p == 0, p == contact.hardness
    assert (inside | off | plastic).all()
    plane = gap[inside].mean() if inside.any() else (gap[plastic].max() + gap[off].min()) / 2
    broken = [np.abs(gap[inside] - plane).max(initial=0.0)]
    broken += [(plane - gap[off]).max()] if off.any() else []
    broken += [(gap[plastic] - plane).max()] if plastic.any() else []
    return max(broken) / contact.heights.std()


def test_heights_in_the_order_of_fortran_give_the_same_contact():
    """A transposed array is such a view; kernels had written to copies of it, and the gap came out 0 on average."""
    heights = rough(64)[:, :48]
    one, other = (
        Press(values, (2e-6, 1e-6), MODULUS).at(1e-3 * MODULUS) for values in (heights, np.asfortranarray(heights))
    )
    assert np.array_equal(one.gap, other.gap)
    assert one.gap.min() == 0


@pytest.mark.parametrize(("load", "hardness"), [(1e-5, np.inf), (4e-3, np.inf), (0.05, np.inf), (0.02, 0.05), (0.9, 1)])
def test_the_pressure_returned_keeps_the_conditions_of_contact(load, hardness):
    contact = Press(rough(128), (SIDE / 128,) * 2, MODULUS, hardness=hardness * MODULUS).at(load * MODULUS)
    assert violation(contact, MODULUS) <= 1.01e-8
    assert contact.complementarity == pytest.approx(violation(contact, MODULUS), rel=0.02)
    assert contact.pressure.mean() == pytest.approx(load * MODULUS, rel=1e-11)
    assert contact.iterations <= 100


@pytest.mark.parametrize(("nx", "ny"), [(97, 64), (64, 97), (101, 103), (30, 200), (2, 7)])
def test_any_shape_and_pixel_will_do(nx, ny):
    heights = np.random.default_rng(5).standard_normal((nx, ny)) * 1e-8
    contact = Press(heights, (SIDE / 60, SIDE / 100), MODULUS, hardness=0.01 * MODULUS).at(2e-3 * MODULUS)
    assert violation(contact, MODULUS) <= 1.01e-8


def test_what_was_deformed_plastically_is_elastic_the_second_time():
    heights, spacing = rough(128), (SIDE / 128,) * 2
    press = Press(heights, spacing, MODULUS, hardness=0.04 * MODULUS)
    first = press.at(0.015 * MODULUS, tolerance=1e-11)
    assert first.plastic_fraction > 0.1
    again = Press(first.unloaded_heights, spacing, MODULUS).at(0.015 * MODULUS, tolerance=1e-11)
    assert np.abs(again.pressure - first.pressure).max() <= 1e-6 * first.hardness
    assert again.pressure.max() <= first.hardness * (1 + 1e-6)
    assert again.gap == pytest.approx(first.gap, abs=1e-9 * heights.std())
    assert (
        not Press(first.unloaded_heights, spacing, MODULUS, hardness=first.hardness * (1 + 1e-6))
        .at(0.015 * MODULUS, tolerance=1e-10)
        .plastic_displacement.any()
    )


def test_full_contact_of_an_egg_box_is_exact():
    n = 48
    x = np.arange(n) / n * SIDE
    box = EggBox(amplitude=1e-6, wavelength=SIDE, composite_modulus=MODULUS)
    heights = 1e-6 * np.outer(np.cos(2 * np.pi * x / SIDE), np.cos(2 * np.pi * x / SIDE))
    load = 1.5 * box.full_contact_load
    contact = Press(heights, (SIDE / n, SIDE / n), MODULUS).at(load)
    exact = box.full_contact_pressure(x[:, None], x[None, :], load)
    assert np.abs(contact.pressure - exact).max() <= 1e-12 * load
    assert contact.area_fraction == contact.area_fraction_pixel == 1
    assert contact.mean_gap == 0


@pytest.mark.parametrize("across", [False, True])
def test_line_contact_of_a_wave_is_westergaards(across):
    n = 8192
    exact = Westergaard(amplitude=1e-6, wavelength=SIDE, composite_modulus=MODULUS, load=0.3 * math.pi * MODULUS * 1e-3)
    heights = 1e-6 * np.cos(2 * np.pi * np.arange(n) / n).reshape((1, n) if across else (n, 1))
    contact = Press(heights, (SIDE / n, SIDE / n), MODULUS).at(exact.load)
    assert contact.mean_gap == pytest.approx(exact.mean_gap, abs=4e-8 * 1e-6)
    assert contact.approach == pytest.approx(exact.approach, abs=4e-8 * 1e-6)
    assert contact.area_fraction == pytest.approx(exact.area_fraction, rel=3e-5)


def test_the_gap_of_a_wave_converges_with_the_second_order():
    errors = []
    loads = np.linspace(0.25, 0.35, 9)
    sizes = (64, 128, 256, 512)
    for n in sizes:
        error = []
        for load in loads:
            exact = Westergaard(
                amplitude=1e-6, wavelength=SIDE, composite_modulus=MODULUS, load=load * math.pi * MODULUS * 1e-3
            )
            heights = 1e-6 * np.cos(2 * np.pi * np.arange(n) / n)[:, None]
            contact = Press(heights, (SIDE / n, SIDE / n), MODULUS).at(exact.load)
            error.append(contact.mean_gap - exact.mean_gap)
        errors.append(np.sqrt(np.mean(np.square(error))))
    slope = np.polyfit(np.log(sizes), np.log(errors), 1)[0]
    assert -2.6 <= slope <= -1.7


def sphere(n, force):
    side = 1e-3
    x = (np.arange(n) - (n - 1) / 2) * side / n
    heights = -(x[:, None] ** 2 + x[None, :] ** 2) / (2 * 0.01)
    return Press(heights, (side / n, side / n), MODULUS, boundary="free").at(force / side**2), x


def test_a_sphere_alone_is_hertzs_with_a_convergence_order():
    exact = HertzSphere(radius=0.01, composite_modulus=MODULUS, force=100.0)
    assert 5 * exact.contact_radius < 1e-3
    sizes, radius, approach, peak = (32, 64, 128, 256), [], [], []
    for n in sizes:
        contact, x = sphere(n, exact.force)
        radius.append(math.sqrt(contact.area_fraction * 1e-6 / math.pi) / exact.contact_radius - 1)
        touch = 2 * (np.abs(x).min()) ** 2 / (2 * 0.01)  # the highest node is not the crown itself
        approach.append((contact.approach + touch) / exact.approach - 1)
        peak.append(contact.pressure.max() / exact.largest_pressure - 1)
    assert abs(radius[-1]) < 5e-3
    assert abs(approach[-1]) < 3e-4
    assert abs(peak[-1]) < 3e-3
    assert np.polyfit(np.log(sizes), np.log(np.abs(approach)), 1)[0] < -1.2
    assert contact.elastic_displacement.min() > 0


def test_a_cylinder_alone_is_hertzs():
    n, side = 4096, 1e-3
    exact = HertzCylinder(radius=0.01, composite_modulus=MODULUS, force_per_length=1e5)
    x = (np.arange(n) - (n - 1) / 2) * side / n
    contact = Press((-(x**2) / 0.02)[:, None], (side / n, side), MODULUS, boundary="free").at(1e5 / side)
    pressure = contact.pressure[:, 0]
    assert contact.area_fraction * side / 2 == pytest.approx(exact.half_width, rel=3e-3)
    within = np.abs(x) < 0.95 * exact.half_width
    assert np.abs(pressure - exact.pressure(x))[within].max() < 2e-3 * exact.largest_pressure


def test_at_a_vanishing_hardness_the_area_is_the_load_over_it():
    heights = rough(128)
    for hardness in (1e-3, 1e-4):
        contact = Press(heights, (SIDE / 128,) * 2, MODULUS, hardness=hardness * MODULUS).at(0.2 * hardness * MODULUS)
        deviation = contact.area_fraction_pixel - 0.2
        assert 0 <= deviation < 12 * hardness
        highest = np.sort(heights.ravel())[::-1][int(0.2 * heights.size)]
        assert (contact.in_contact == (heights >= highest)).mean() > 1 - 60 * hardness


def test_area_grows_at_first_by_about_two_loads_over_the_mean_slope():
    """κ = A E* g'/P, less what pixels add: between Persson's 1.6 and Bush, Gibson and Thomas's 2.5."""
    n, found = 1024, []
    for seed in (20071, 5, 6):
        press, contact = Press(rough(n, seed), (SIDE / n, SIDE / n), MODULUS), None
        for load in (5e-4, 1e-3, 2.5e-3):
            contact = press.at(load * MODULUS, tolerance=1e-5, start=contact)
            found.append(contact.area_fraction * 0.1 * MODULUS / contact.load)
    assert 2.0 <= np.mean(found) <= 2.2
    assert 1.9 <= min(found) <= max(found) <= 2.35


def test_a_start_changes_nothing_but_the_work():
    press = Press(rough(128), (SIDE / 128,) * 2, MODULUS, hardness=0.06 * MODULUS)
    first = press.at(0.01 * MODULUS)
    cold, warm = press.at(0.012 * MODULUS), press.at(0.012 * MODULUS, start=first)
    assert warm.mean_gap == pytest.approx(cold.mean_gap, abs=1e-7 * press.heights.std())
    assert press.at(0.012 * MODULUS, start=cold).iterations <= 2 < cold.iterations


def test_what_was_solved_before_leaves_nothing_behind():
    used, new = (Press(rough(128), (SIDE / 128,) * 2, MODULUS, hardness=0.06 * MODULUS) for _ in range(2))
    start = used.at(0.03 * MODULUS)
    begun, fresh = (press.at(0.012 * MODULUS, start=start) for press in (used, new))
    assert np.array_equal(begun.pressure, fresh.pressure)


def test_threads_change_nothing_but_the_time(monkeypatch):
    monkeypatch.setattr("roughfilm.contact.mechanics.press.NODES_PER_THREAD", 1)
    one, two = (Press(rough(64), (SIDE / 64,) * 2, MODULUS, threads=threads).at(0.01 * MODULUS) for threads in (1, 2))
    assert two.mean_gap == pytest.approx(one.mean_gap, abs=1e-7 * one.heights.std())
    assert (two.in_contact == one.in_contact).mean() > 0.9999


@pytest.mark.parametrize("shape", [(64, 1), (1, 64), (3, 64), (64, 3), (5, 7)])
@pytest.mark.parametrize("boundary", ["periodic", "free"])
def test_more_threads_than_rows_or_columns_share_too(shape, boundary, monkeypatch):
    monkeypatch.setattr("roughfilm.contact.mechanics.press.NODES_PER_THREAD", 1)
    heights = np.random.default_rng(20072).standard_normal(shape) * 1e-3
    one, many = (Press(heights, (1.0, 1.0), 1.0, boundary=boundary, threads=threads).at(1e-4) for threads in (1, 16))
    assert many.pressure == pytest.approx(one.pressure, abs=1e-6 * one.pressure.max())


@pytest.mark.parametrize("load", [5e-4, 5e-3, 3e-2])
def test_iterations_do_not_grow_with_the_grid(load):
    """Without the extension of the residual there are 17 to 39 on 256² points and 24 to 48 on 512²."""
    for n in (256, 512):
        contact = Press(rough(n), (SIDE / n,) * 2, MODULUS).at(load * MODULUS)
        assert contact.iterations <= 21
        assert violation(contact, MODULUS) <= 1.01e-8


def test_lists_of_free_nodes_grow_when_contact_does(monkeypatch):
    monkeypatch.setattr("roughfilm.contact.mechanics.press.NODES_PER_THREAD", 1)
    press = Press(rough(128), (SIDE / 128,) * 2, MODULUS, hardness=0.06 * MODULUS, threads=3)
    little = press.at(1e-5 * MODULUS)
    assert np.count_nonzero(little.in_contact) < 30
    grown, cold = press.at(0.04 * MODULUS, start=little), press.at(0.04 * MODULUS)
    assert violation(grown, MODULUS) <= 1.01e-8
    assert grown.mean_gap == pytest.approx(cold.mean_gap, abs=1e-7 * press.heights.std())
    assert (grown.in_contact == cold.in_contact).mean() > 0.9999


def test_memory_is_that_of_the_grids_and_of_the_nodes_in_contact():
    heights = rough(512)
    press = Press(heights, (SIDE / 512,) * 2, MODULUS)
    tracemalloc.start()
    try:
        press.at(2e-3 * MODULUS)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak <= 60 * heights.size


def test_units_change_nothing():
    heights = rough(64)
    press = Press(heights, (SIDE / 64,) * 2, MODULUS, hardness=0.05 * MODULUS)
    other = Press(heights * 1e6, (SIDE / 64 * 1e6,) * 2, MODULUS * 1e-9, hardness=0.05 * MODULUS * 1e-9)
    a, b = press.at(0.01 * MODULUS), other.at(0.01 * MODULUS * 1e-9)
    assert b.mean_gap == pytest.approx(a.mean_gap * 1e6, rel=1e-6)
    assert b.area_fraction == a.area_fraction


def test_a_load_at_the_hardness_is_carried_everywhere():
    contact = Press(rough(64), (SIDE / 64,) * 2, MODULUS, hardness=1e9).at(1e9)
    assert (contact.pressure == 1e9).all()
    assert contact.plastic_fraction == contact.area_fraction == 1
    assert contact.loaded_heights == pytest.approx(contact.loaded_heights[0, 0], abs=1e-12)
    assert contact.plastic_displacement.min() >= 0


def test_just_below_the_hardness_it_converges_too():
    contact = Press(rough(128), (SIDE / 128,) * 2, MODULUS, hardness=0.05 * MODULUS).at(0.999 * 0.05 * MODULUS)
    assert violation(contact, MODULUS) <= 1.01e-8
    assert contact.iterations <= 100


def test_a_profile_with_many_tips_converges():
    """Conjugate steps alone went in circles on one like this."""
    n, wave = 4096, np.arange(2049)
    amplitudes = np.where((wave >= 4) & (wave <= 256), np.maximum(wave, 1.0) ** -0.8, 0)
    phases = np.random.default_rng(20071).uniform(0, 2 * np.pi, wave.size)
    profile = np.fft.irfft(amplitudes * np.exp(1j * phases), n)
    profile *= 0.1 / np.std(np.diff(profile) * n)
    hardness = 0.05 * MODULUS
    contact = Press(profile[:, None], (1 / n, 1.0), MODULUS, hardness=hardness).at(0.3 * hardness)
    assert violation(contact, MODULUS) <= 1.01e-8
    assert contact.iterations <= 300
    assert contact.plastic_fraction > 0


def test_a_flat_surface_bears_its_load_evenly():
    contact = Press(np.full((16, 8), 3e-6), (1e-6, 1e-6), MODULUS).at(1e6)
    assert contact.pressure == pytest.approx(1e6)
    assert contact.mean_gap == contact.complementarity == 0


@settings(max_examples=25, deadline=None)
@given(
    seed=st.integers(2, 10_000),
    nx=st.integers(2, 40),
    ny=st.integers(1, 40),
    load=st.floats(-7, 1),
    hardness=st.floats(-3, 3),
    aspect=st.floats(-1, 1),
)
def test_random_surfaces_at_random_loads_keep_the_conditions(seed, nx, ny, load, hardness, aspect):
    heights = np.random.default_rng(seed).standard_normal((nx, ny))
    slope = heights.std() if nx * ny > 1 else 1.0
    spacing = (1.0, 10.0**aspect)
    limit = 10.0**hardness * MODULUS * slope
    pressure = min(10.0**load * MODULUS * slope, 0.999 * limit)
    contact = Press(heights, spacing, MODULUS, hardness=limit).at(pressure)
    assert violation(contact, MODULUS) <= 1.01e-8
    assert contact.pressure.mean() == pytest.approx(pressure, rel=1e-10)
    assert contact.pressure.min() >= 0
    assert contact.pressure.max() <= limit


@pytest.mark.parametrize(
    ("change", "word"),
    [
        ({"heights": np.zeros((0, 0))}, "shape"),
        ({"heights": np.full((4, 4), np.nan)}, "not finite"),
        ({"heights": np.full((4, 4), np.inf)}, "not finite"),
        ({"heights": np.full((4, 4), 1e9)}, "unit"),
        ({"spacing": (0.0, 1.0)}, "spacing"),
        ({"composite_modulus": -1.0}, "modulus"),
        ({"composite_modulus": np.nan}, "modulus"),
        ({"hardness": 0.0}, "hardness"),
        ({"hardness": np.nan}, "hardness"),
        ({"boundary": "open"}, "boundary"),
        ({"threads": 0}, "threads"),
        ({"load": 0.0}, "load"),
        ({"load": -1.0}, "load"),
        ({"load": np.nan}, "load"),
        ({"load": np.inf}, "load"),
        ({"load": 2e9}, "hardness"),
        ({"tolerance": 0.0}, "tolerance"),
    ],
)
def test_what_makes_no_sense_is_one_clear_line(change, word):
    known = {"heights": np.arange(16.0).reshape(4, 4) * 1e-6, "spacing": (1e-6, 1e-6), "composite_modulus": MODULUS}
    known |= {"hardness": 1e9, "load": 1e6} | change
    load, tolerance = known.pop("load"), known.pop("tolerance", 1e-8)
    heights, spacing, modulus = (known.pop(name) for name in ("heights", "spacing", "composite_modulus"))
    with pytest.raises(InputError, match=word) as caught:
        Press(heights, spacing, modulus, **known).at(load, tolerance=tolerance)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("hardness", [3e-3, 1e-2, 3e-2, np.inf])
def test_no_area_carries_more_than_its_hardness(hardness):
    press = Press(rough(128), (SIDE / 128,) * 2, MODULUS, hardness=hardness * MODULUS)
    for part in (0.05, 0.3, 0.7):
        contact = press.at(part * min(hardness, 0.1) * MODULUS)
        assert contact.area_fraction * contact.hardness >= contact.load
        assert contact.plastic_fraction <= contact.area_fraction <= contact.area_fraction_pixel


def test_counting_pixels_less_their_perimeter_finds_the_area_of_hertz():
    exact = HertzSphere(radius=0.01, composite_modulus=MODULUS, force=100.0)
    corrected, counted = [], []
    for n in range(60, 76):
        contact, _ = sphere(n, exact.force)
        area = math.pi * exact.contact_radius**2 / 1e-6
        corrected.append(contact.area_fraction / area - 1)
        counted.append(contact.area_fraction_pixel / area - 1)
    assert abs(np.mean(corrected)) < 0.4 * abs(np.mean(counted))


@pytest.mark.parametrize("points", [1, 2, 409, 2048])
@pytest.mark.parametrize("change", [0.0, 1e-12, -1e-9, -1e-6])
@pytest.mark.parametrize("hardness", [2e-6, 3e-4, 0.013])
def test_a_load_that_whole_pixels_carry_at_the_hardness_is_solved(points, change, hardness):
    press = Press(rough(64), (SIDE / 64,) * 2, MODULUS, hardness=hardness * MODULUS)
    load = points / 64**2 * (1 + change) * press.hardness
    contact = press.at(load)
    assert violation(contact, MODULUS) <= 1.01e-8
    assert contact.pressure.mean() == pytest.approx(load, rel=1e-8)


def test_full_contact_is_certified_like_any_other():
    wave = np.cos(2 * np.pi * np.arange(32) / 32)
    press = Press(1e-12 * np.add.outer(wave, wave), (SIDE / 32,) * 2, MODULUS)
    assert press.at(1e6, tolerance=1e-10).complementarity <= 1e-10
    with pytest.raises(ConvergenceError, match="ask for a looser tolerance") as caught:
        press.at(1e12, tolerance=1e-10)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("side", [2, 3, 4, 8, 16])
@pytest.mark.parametrize("load", [1e-7, 1e-5])
def test_the_area_of_pillars_is_that_of_their_pixels(side, load):
    heights = np.zeros((64, 64))
    heights[8 : 8 + side, 8 : 8 + side] = heights[40 : 40 + side, 30 : 30 + side] = 1e-6
    contact = Press(heights, (1e-6, 1e-6), MODULUS).at(load * MODULUS)
    assert contact.area_fraction == contact.area_fraction_pixel == 2 * side**2 / 64**2


def test_the_area_of_round_pillars_is_theirs():
    x = np.arange(128) - 64
    radius = 20
    heights = np.where(np.hypot(x[:, None] + 0.3, x[None, :] + 0.2) < radius, 1e-5, 0.0)
    contact = Press(heights, (1e-6, 1e-6), MODULUS).at(1e-5 * MODULUS)
    assert contact.area_fraction == pytest.approx(math.pi * radius**2 / 128**2, rel=2e-3)
