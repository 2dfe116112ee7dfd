"""Walls that slide back: mirror images, steady films of both directions, conservation and order across the reversal."""

from dataclasses import replace

import numpy as np
import pytest
from moving_films import CLEARANCE, RADIUS, SPEED, course, journal, order, plates, steady, stored

from roughfilm.rom.cavitation.balance import CAVITY
from roughfilm.rom.cavitation.motion.coupled import turned_round
from roughfilm.rom.cavitation.motion.march import begun, march

PLACE = np.array([0.4, -0.3]) * CLEARANCE
TURN = 2 * np.pi * RADIUS / SPEED


def swinging(time):
    """A speed that changes its sign after a quarter of the time of a turn."""
    return SPEED * np.cos(2 * np.pi * time / TURN)


def carried(film, speed, start, steps=40):
    """The steps of a shaft under a load that grows from that of its start while its speed is reversed."""
    first = -(film.mirrored if start.turned else film).force(start.instant.state.pressure)

    def force(time):
        return first * (1 + 0.3 * np.sin(2 * np.pi * time / TURN) ** 2)

    load, end = course(film, force=force, speed=speed, mass=20.0), 0.6 * TURN
    return list(march(film, load, start, end, largest_step=end / steps, error=None, tolerance=1e-11))


@pytest.fixture(scope="module")
def swung():
    """A journal with a cavity, its film at the start, and its steps."""
    film = journal((32, 6), halved=True)
    start = steady(film, PLACE)
    steps = carried(film, swinging, begun(film, start))
    assert {moving.turned for moving in steps} == {False, True}
    assert (steps[-1].instant.kind == CAVITY).any()
    return film, start, steps


def test_a_film_mirrored_twice_is_the_film(swung):
    film, start, steps = swung
    twice, held = film.mirrored.mirrored, steps[-1].now.held
    np.testing.assert_allclose(twice.grid.x, film.grid.x, atol=1e-15)
    np.testing.assert_allclose(twice.faces(PLACE).parts, start.faces.parts, rtol=1e-12)
    assert [nodes.tolist() for nodes in twice.covered] == [nodes.tolist() for nodes in film.covered]
    assert film.turned_round(film.turned_round(held)).tobytes() == held.tobytes()


def test_the_mirrored_film_with_the_opposite_speed_is_the_mirror_image(swung):
    film, start, steps = swung
    back = film.mirrored
    image = carried(back, lambda time: -swinging(time), begun(back, turned_round(film, start)))
    for one, other in zip(steps, image, strict=True):
        assert other.turned != one.turned
        assert other.now.place == pytest.approx(one.now.place, abs=1e-9 * CLEARANCE)
        assert other.now.held == pytest.approx(one.now.held, abs=1e-9 * CLEARANCE)  # both in the direction of sliding


def test_what_a_journal_stores_is_what_flows_in_less_what_flows_out_across_the_reversal(swung):
    film, start, steps = swung
    before = begun(film, start)
    for moving in steps:
        instant = moving.instant
        entered = instant.balance[instant.network.fixed]
        assert abs(entered.sum() - stored(film, before, moving)) < 1e-9 * np.abs(entered).max()
        before = moving


def test_steps_across_the_reversal_are_of_second_order(swung):
    film, start, steps = swung
    ends = [carried(film, swinging, begun(film, start), count)[-1] for count in (20, 80, 160)]
    ends.insert(1, steps[-1])
    areas = film.grid.areas
    for values in ([end.now.place[0] for end in ends], [float((areas * end.now.held).sum()) for end in ends]):
        assert order([4.0, 2.0, 1.0], np.diff(values)) == pytest.approx(2.0, abs=0.3)


def test_a_speed_that_is_slowly_reversed_has_the_steady_films_of_both_directions():
    """h is even in the angle but for sin φ, whose coordinate and force change their sign with the speed."""
    film = journal((32, 6), halved=True)
    forth, period = steady(film, PLACE), 80 * TURN
    moves = course(film, place=lambda _time: PLACE, speed=lambda time: SPEED * np.cos(2 * np.pi * time / period))
    *_, last = march(film, moves, begun(film, forth), 0.5 * period, largest_step=period / 120, error=None)
    assert last.turned
    flip = np.array([1.0, -1.0])
    image = flip * film.force(steady(film, flip * PLACE).state.pressure)
    assert film.mirrored.force(last.instant.state.pressure) == pytest.approx(image, rel=2e-3)


def test_a_wall_that_turns_back_brings_its_lubricant_back():
    """Without pressure the centre of what is more than the rest moves by ∫ u/2 dt, forth and back."""
    film = plates(200, theta=0.5, thickness=lambda x, y: 1 + 0 * x + 0 * y, speed=1.0)
    x = film.grid.x
    first = steady(film, [0.0])
    fill = np.where(np.abs(x[:, None] - 0.5) < 0.1, 0.9, 0.5)
    start = begun(film, replace(first, state=replace(first.state, fill=np.where(first.kind == CAVITY, fill, 1.0))))
    moves = course(film, place=lambda _time: np.zeros(1), speed=lambda time: np.cos(2 * np.pi * time))
    for moving in march(film, moves, start, 0.5, largest_step=0.5 / 100, error=None):
        held = film.turned_round(moving.now.held) if moving.turned else moving.now.held
        more = np.where(np.abs(x - 0.5) < 0.35, held[:, 0] - 0.5, 0.0)
        moved = np.sin(2 * np.pi * moving.now.time) / (4 * np.pi)
        assert float(x @ more / more.sum()) == pytest.approx(0.5 + moved, abs=2e-4)
