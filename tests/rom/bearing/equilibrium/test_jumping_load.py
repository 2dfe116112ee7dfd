"""Films whose load jumps, or falls below that of a wide film and rises again, over the film thickness."""

import math
from dataclasses import dataclass, field
from typing import Any

import pytest

from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.rom.bearing.equilibrium.balance import FilmsAtSpeed, balanced, robustly_balanced


@dataclass(frozen=True)
class Solved:
    """A film with its load."""

    load: float
    solution: Any = field(default_factory=lambda: type("Solved", (), {"levels": (), "state": None})())


@dataclass(frozen=True)
class Jumping:
    """A film that carries 2 N up to 3 µm and 0.5 N above."""

    area: float = 1.0
    closest: float = 1e-7
    touching: float = 1e-6
    widest: float = 1e-4
    remedy: str = "lower the load"

    def at(self, separation: float, _speed: float, _start: object, /) -> Solved:
        return Solved(load=2.0 if separation <= 3e-6 else 0.5)

    def contact_load(self, _separation: float, /) -> float:
        return 0.0


def test_a_load_within_a_jump_ends_with_the_place_of_the_jump() -> None:
    with pytest.raises(ConvergenceError, match=r"jumps at a minimum film thickness of 3e-06 m"):
        balanced(FilmsAtSpeed(film=Jumping(), speed=1.0), 1.0, tolerance=1e-7)


@dataclass(frozen=True)
class Fed(Jumping):
    """A film that carries 1.2 N by the pressure around it where it is wide, and less about 3 µm, where it is sucked."""

    touching: float = 5e-5

    def at(self, separation: float, _speed: float, _start: object, /) -> Solved:
        sucked = math.exp(-(math.log(separation / 3e-6) ** 2))
        return Solved(load=1.2 - sucked + (5e-7 / separation) ** 3)


def test_a_film_that_carries_less_than_a_wide_one_is_found_where_it_is_stable() -> None:
    at = FilmsAtSpeed(film=Fed(), speed=1.0)
    found = robustly_balanced(at, 1.0, tolerance=1e-7)
    assert found.load == pytest.approx(1.0, rel=1e-6)
    film = next(place for place, load in at.loads.items() if load == found.load)
    assert Fed().at(film * 0.99, 1.0, None).load > 1.0 > Fed().at(film * 1.01, 1.0, None).load
