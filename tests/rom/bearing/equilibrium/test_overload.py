"""Loads that no speed carries are refused without a solution at each speed."""

import pytest

from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome
from roughfilm.rom.bearing.equilibrium.overload import refuse_overload

SPEEDS = (1.0, 2.0, 3.0, 4.0, 5.0)


def bearing(carried, tried, error=InputError):
    def at(speed):
        tried.append(speed)
        if speed not in carried:
            raise error(f"load: refused at {speed}") if error is InputError else error("", outcome=Outcome.STALLED)

    return at


def test_a_load_that_the_largest_speed_does_not_carry_is_refused():
    tried = []
    with pytest.raises(InputError, match=r"5\.0"):
        refuse_overload(bearing((), tried), SPEEDS)
    assert tried == [3.0, 5.0]


@pytest.mark.parametrize("carried", [(3.0,), (5.0,), (3.0, 4.0, 5.0)])
def test_a_load_that_some_speeds_carry_is_not(carried):
    refuse_overload(bearing(carried, []), SPEEDS)


def test_a_film_that_does_not_converge_refuses_no_load():
    refuse_overload(bearing((), [], ConvergenceError), SPEEDS)


def test_few_speeds_are_not_tried_twice():
    tried = []
    refuse_overload(bearing((), tried), SPEEDS[:3])
    assert not tried
