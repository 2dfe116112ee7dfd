"""Films that test the cavitation solvers, and the judgement of the answers."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

from roughfilm.rom.bearing.geometry.shapes import Linear, Parabolic
from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.exact import exact
from roughfilm.rom.cavitation.network import State
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.shape import Shape
from roughfilm.rom.cavitation.solve import Solution, solve
from roughfilm.rom.lubricants.compressibility import ConstantBulkModulus
from roughfilm.rom.lubricants.laws import Compressibility
from roughfilm.stability.checks.cavitation import broken_balance
from roughfilm.stability.form import Judgement, Probe

SPEED = 4.57
"""Sliding speed, m/s."""

VISCOSITY = 0.039
"""Viscosity, Pa s."""

LENGTH = 76.2e-3
"""Length of the sliders, m."""

FILM = 25.4e-6
"""Smallest film thickness, m."""

PRESSURE_UNIT = 6 * VISCOSITY * SPEED * LENGTH / FILM**2
"""Unit of pressure, 6 η u L/h², Pa."""

SEED = 20071
"""Seed of the random films and states."""

SECOND_ORDER_FACTOR = 100.0
"""Allowed relative error of a load, divided by (cell/length)²."""

ERROR_FLOOR = 1e-6
"""Allowed relative error of a load on the finest grids, due to the solver's tolerance."""

BALANCE_TOLERANCE = 1e-8
"""Allowed net flow into a node, recomputed, over the largest flow: ten times the tolerance of the solver."""

ROUND_OFF = 1e-12
"""Allowed difference of answers that are equal but for round-off."""

CELLS = 1000
"""Number of cells of a line."""

Answer = tuple[int, float]
"""An answer: the number of Newton steps on all grids, and the error."""


def film_probe(
    group: str, row: str, column: str, ask: Callable[[], Answer], bound: float, *, refused: bool = False
) -> Probe:
    """A probe whose answer is right if its error is at most ``bound``."""
    judge = partial(judged, bound=bound)
    return Probe(group=group, row=row, column=column, ask=ask, judge=judge, refused=refused)


def judged(answer: Answer, bound: float) -> Judgement:
    """The judgement of an answer by the bound of its error."""
    iterations, error = answer
    right = bool(error <= bound)
    return Judgement(
        iterations=iterations,
        right=right,
        error=error,
        numbers={"allowed": bound},
        message="" if right else f"error {error:.2g}, allowed {bound:.2g}",
    )


def bound(cells: int) -> float:
    """The allowed relative error 100/n² + 1e-6 of a load of second order on n ``cells``."""
    return SECOND_ORDER_FACTOR / cells**2 + ERROR_FLOOR


def liquid(gigapascals: float) -> ConstantBulkModulus:
    """A liquid with a constant bulk modulus, which is given in GPa."""
    return ConstantBulkModulus(law="constant_bulk_modulus", bulk_modulus=f"{gigapascals!r} GPa")  # type: ignore[arg-type]


def slider(theta: float, compressibility: Compressibility) -> Problem:
    """The film problem of the parabolic slider with the filling fraction ``theta`` at its inlet."""
    return film(parabola(), Ends(theta=theta), compressibility=compressibility)


def parabola(**given: object) -> Shape:
    """The shape of a parabolic film that is twice as thick at its inlet and outlet as in its middle."""
    lengths = {"length": metres(LENGTH), "film": metres(FILM), "rise": metres(FILM)}
    return Parabolic(shape="parabolic", **lengths, **given).film_shape()  # type: ignore[arg-type]


def linear() -> Shape:
    """The shape of a linear film whose inlet is twice as thick as its outlet."""
    return Linear(shape="linear", length=metres(LENGTH), film=metres(FILM), rise=metres(FILM)).film_shape()


def mirrored(shape: Shape) -> Shape:
    """The shape of the film mirrored in x."""
    breaks = tuple(LENGTH - place for place in reversed(shape.breaks))
    return replace(shape, breaks=breaks, thickness=lambda x, y: shape.thickness(LENGTH - x, y))


def metres(value: float) -> float:
    """The text of a length in m, with its unit, as the classes of a scene read it."""
    return f"{value!r} m"  # type: ignore[return-value]


def film(shape: Shape, ends: Ends, **given: object) -> Problem:
    """The film problem of a shape, with ``SPEED`` and ``VISCOSITY`` unless others are given."""
    return Problem(**{"shape": shape, "ends": ends, "speed": SPEED, "viscosity": VISCOSITY, **given})  # type: ignore[arg-type]


def load_error(load: float, truth: float) -> float:
    """The relative error of a load (N/m); it is relative to the unit of load if the true load is 0."""
    return abs(load - truth) / (truth or PRESSURE_UNIT * LENGTH)


def steps_of(solution: Solution) -> int:
    """The number of Newton steps on all grids."""
    return sum(level.iterations for level in solution.levels)


def balance(problem: Problem, cells: tuple[int, int]) -> Answer:
    """Solve a film, and measure the error by the largest net flow into a node."""
    solution = solve(problem, cells)
    return steps_of(solution), broken_balance(solution)


def against(problem: Problem, cells: int, truth: Callable[[], float], start: State | None = None) -> Answer:
    """Solve a film from a state ``start``, and measure the relative error of its load against ``truth()``, N/m."""
    solution = solve(problem, (cells, 1), start=start)
    return steps_of(solution), load_error(solution.levels[-1].load, truth())


def against_exact(problem: Problem, cells: int, start: State | None = None) -> Answer:
    """Solve a film, and measure the relative error of its load against the exact load."""
    return against(problem, cells, lambda: exact(problem).load, start)
