"""Films that the solvers of cavitation are asked for, and how an answer is judged."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from roughfilm.rom.bearing.shapes import Linear, Parabolic
from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.exact import exact
from roughfilm.rom.cavitation.network import State
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.shape import Shape
from roughfilm.rom.cavitation.solve import Solution, solve
from roughfilm.rom.lubricants.compressibility import ConstantBulkModulus
from roughfilm.rom.lubricants.laws import Compressibility
from roughfilm.stability.checks.cavitation import broken_balance

SPEED, VISCOSITY = 4.57, 0.039
"""m/s, Pa s."""

LENGTH, FILM = 76.2e-3, 25.4e-6
"""m."""

UNIT = 6 * VISCOSITY * SPEED * LENGTH / FILM**2
"""Pa, of the pressures."""

SEED = 20071

SECOND_ORDER, FLOOR = 100.0, 1e-6
"""A load may be off by so many squares of a cell over the length, and by what the tolerances leave."""

BALANCED = 1e-8
"""A net flow into a node, over the largest flow, recomputed: ten times what is asked of the solver."""

SAME = 1e-12
"""What is the same but for rounding."""

CELLS = 1000
"""On lines."""

SOLVED, REFUSED = "solved", "refused"


@dataclass(frozen=True, kw_only=True)
class Answer:
    """What a question gave: Newton's steps on all grids, and by how much the answer is off."""

    iterations: int
    error: float


@dataclass(frozen=True, kw_only=True)
class Probe:
    """One question: where it stands on the page, how it is asked, how much the answer may be off, what is expected."""

    group: str
    row: str
    column: str
    ask: Callable[[], Answer]
    bound: float
    expected: str = SOLVED


def bound(cells: int) -> float:
    """What a load of second order in the cells may be off."""
    return SECOND_ORDER / cells**2 + FLOOR


def liquid(gigapascals: float) -> ConstantBulkModulus:
    """A constant bulk modulus."""
    return ConstantBulkModulus(law="constant_bulk_modulus", bulk_modulus=f"{gigapascals!r} GPa")  # type: ignore[arg-type]


def slider(theta: float, compressibility: Compressibility) -> Problem:
    """The parabolic slider, with so full an inlet."""
    shape = Parabolic(shape="parabolic", length=metres(LENGTH), film=metres(FILM), rise=metres(FILM)).film_shape()
    return film(shape, Ends(theta=theta), compressibility=compressibility)


def off(load: float, wanted: float) -> float:
    """A load's error over what is wanted or, if that is nothing, over the unit."""
    return abs(load - wanted) / (wanted or UNIT * LENGTH)


def metres(value: float) -> float:
    """A length as the scene's classes take it."""
    return f"{value!r} m"  # type: ignore[return-value]


def film(shape: Shape, ends: Ends, **given: object) -> Problem:
    """The film with the speed and viscosity of all questions."""
    return Problem(**{"shape": shape, "ends": ends, "speed": SPEED, "viscosity": VISCOSITY, **given})  # type: ignore[arg-type]


def steps_of(found: Solution) -> int:
    """Newton's steps on all grids."""
    return sum(level.iterations for level in found.levels)


def load_of(found: Solution) -> float:
    """∫ p dx, N/m."""
    return found.levels[-1].load


def balance(problem: Problem, cells: tuple[int, int]) -> Answer:
    """Solve, and judge by the flows into every node."""
    found = solve(problem, cells)
    return Answer(iterations=steps_of(found), error=broken_balance(found))


def against(problem: Problem, cells: int, wanted: Callable[[], float], start: State | None = None) -> Answer:
    """Solve, and judge by the load."""
    found = solve(problem, (cells, 1), start=start)
    return Answer(iterations=steps_of(found), error=off(load_of(found), wanted()))


def known_load(problem: Problem) -> float:
    """The exact one, N/m."""
    return exact(problem).load


def linear() -> Shape:
    """A film that halves towards the outlet."""
    return Linear(shape="linear", length=metres(LENGTH), film=metres(FILM), rise=metres(FILM)).film_shape()


def mirrored(shape: Shape) -> Shape:
    """The film with x turned round."""
    breaks = tuple(LENGTH - place for place in reversed(shape.breaks))
    return replace(shape, breaks=breaks, thickness=lambda x, y: shape.thickness(LENGTH - x, y))
