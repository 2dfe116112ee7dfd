"""The map of the cavitation solvers: the default and two older algorithms against exact solutions."""

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import product

from roughfilm.stability.form import (
    BAD,
    GOOD,
    MapOutcome,
    Probe,
    Spot,
    StabilityMap,
    count,
    in_numbers,
    in_turn,
    listed,
)
from roughfilm.stability.questions.cavitation import probes
from roughfilm.stability.questions.films import (
    ERROR_FLOOR,
    PRESSURE_UNIT,
    SECOND_ORDER_FACTOR,
    Answer,
    bound,
    film_probe,
    liquid,
    load_error,
    slider,
    steps_of,
)

MODULI = (0.05, 0.07, 0.3, 1.0, 10.0, 100.0)
"""Bulk moduli β, GPa."""

THETAS = (0.05, 0.2, 0.4, 0.55, 0.8, 0.95, 1.0)
"""Filling fractions at the inlet of the slider."""

NODES = (100, 1000, 10_000, 100_000)
"""Numbers of nodes of the slider."""

MAX_NODE_STEPS = 30_000_000
"""Largest product of iterations and nodes of the switch algorithm, whose iterations are also limited to 3000."""

DEFAULT = "default"
"""Name of the default method."""

METHODS = {
    "switch": "the switch algorithm of the thesis, from a full film without pressure",
    "fbns": "Fischer–Burmeister–Newton–Schur, from a full film without pressure",
    DEFAULT: "the default: Newton's method on an active set, from coarse grids to fine",
}
"""The methods by name, in words."""


def methods(most: int) -> Iterator[Probe]:
    """The probes of the parabolic slider by all three methods, on 100 to ``most`` nodes, judged by its exact load."""
    from roughfilm.rom.cavitation.exact import exact  # numba is slow to import

    loads = {(theta, beta): exact(slider(theta, liquid(beta))).load for theta in THETAS for beta in MODULI}
    sizes = [nodes for nodes in NODES if nodes <= most]
    for method, solver in zip(METHODS, (_switch, _schur, _default), strict=True):
        solver(1.0, 1.0, NODES[0])  # compiles before anything is timed
        for theta, beta, nodes in product(THETAS, MODULI, sizes):
            ask = partial(_error, solver, theta, beta, nodes, loads[theta, beta])
            yield film_probe(method, f"θ = {theta:g}", f"{beta:g} GPa, {nodes}", ask, bound(nodes))


def _error(
    solver: Callable[[float, float, int], tuple[int, float]], theta: float, beta: float, nodes: int, truth: float
) -> Answer:
    iterations, load = solver(theta, beta, nodes)
    return iterations, load_error(load, truth)


def _switch(theta: float, beta: float, nodes: int) -> tuple[int, float]:
    from roughfilm.rom.cavitation.reference.switch import MAX_STEPS, switched

    solution = switched(slider(theta, liquid(beta)), nodes, limit=min(MAX_STEPS, MAX_NODE_STEPS // nodes))
    return solution.iterations, solution.load


def _schur(theta: float, beta: float, nodes: int) -> tuple[int, float]:
    from roughfilm.rom.cavitation.discretise import faces, network
    from roughfilm.rom.cavitation.grid import grid
    from roughfilm.rom.cavitation.reference.fischer_burmeister import fischer_burmeister

    problem = slider(theta, liquid(beta))
    cells = grid(problem.shape, (nodes, 1))
    net = network(
        cells,
        faces(problem.shape, cells),
        problem.ends,
        speed=problem.speed,
        viscosity=problem.viscosity,
        compressibility=problem.initial_compressibility,
    )
    solution = fischer_burmeister(net, problem, pressure_unit=PRESSURE_UNIT)
    return solution.iterations, float((cells.areas * solution.state.pressure).sum())


def _default(theta: float, beta: float, nodes: int) -> tuple[int, float]:
    from roughfilm.rom.cavitation.solve import solve

    solution = solve(slider(theta, liquid(beta)), (nodes, 1))
    return steps_of(solution), solution.levels[-1].load


def summary(spots: Sequence[Spot]) -> list[str]:
    """Sentences about the map: the results of each method, and of the other probes of the default solver."""
    lines = []
    for method, words in METHODS.items():
        own = [spot for spot in spots if spot.group == method]
        if good := [spot for spot in own if spot.outcome in GOOD]:
            most, worst = max(spot.iterations or 0 for spot in good), max(spot.error or 0.0 for spot in good)
            lines.append(
                f"{words[0].upper()}{words[1:]}: {in_numbers(own)}; at most {most} iterations and an error of the load "
                f"of at most {worst:.1e} where right, {sum(spot.cpu_s for spot in own):.2g} s in all."
            )
    others = [spot for spot in spots if spot.group not in METHODS]
    if others:
        right = count(others, *GOOD, MapOutcome.REFUSED)
        lines.append(f"{right} of {len(others)} other probes of the default solver end as they must.")
    return lines + listed(others + [spot for spot in spots if spot.group == DEFAULT], *BAD)


CAVITATION = StabilityMap(
    name="cavitation",
    title="Films that cavitate",
    axes="The parabolic slider, h = 25.4 µm (1 + (2x/L − 1)²), L = 76.2 mm, 4.57 m/s, 39 mPa s: filling fraction of "
    "its inlet (rows), bulk modulus and nodes (columns), by three methods; below θ = 0.5 it has no full film "
    "and no load. Then other films by the default solver.",
    judge="Every load of the slider by an exact solution that shares nothing with the solvers but the lubricant: its "
    f"error may be {SECOND_ORDER_FACTOR:g} (cell/length)² + {ERROR_FLOOR:g}, what a scheme of second order must keep; "
    "every other film by a judge of its own. The switch algorithm is stopped after 3000 iterations, or "
    f"{MAX_NODE_STEPS:g} iterations times nodes. Iterations are those on all grids together.",
    resolution=NODES[-1],
    resolution_meaning="most nodes along the slider",
    least=NODES[0],
    most=NODES[-1],
    allowed=f"the slider takes {NODES[0]} to {NODES[-1]} nodes",
    solve=in_turn(lambda most: (*methods(most), *probes())),
    summary=summary,
)
