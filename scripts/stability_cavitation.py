"""Where films that cavitate converge: the default solver and two older algorithms against exact solutions."""

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from contact.errors import ConvergenceError, InputError
from scripts import stability_spots as spots_of
from scripts.cavitation_probes import probes
from scripts.cavitation_scenes import FLOOR, REFUSED, SECOND_ORDER, Answer, Probe, bound, liquid, off, slider
from scripts.common import progress_bar
from scripts.stability_made import Made
from scripts.stability_spots import MEANING as ALWAYS
from scripts.stability_spots import State, columns_of, count, entries_of, in_groups, in_rows, table_of

MODULI = (0.05, 0.07, 0.3, 1.0, 10.0, 100.0)
"""β, GPa."""

THETAS = (0.05, 0.2, 0.4, 0.55, 0.8, 0.95, 1.0)
"""How full the inlet of the slider is."""

FEWEST, MOST = 100, 100_000
"""Nodes of the slider, and decades between."""

SLOW = 100
"""More iterations than this, on all grids together, are slow."""

WORK = 30_000_000
"""The switch algorithm may take so many iterations times nodes, and at most 3000."""

SWITCH, SCHUR, DEFAULT = "switch", "fbns", "default"

NAMES = {
    SWITCH: "the switch algorithm of the thesis, from a full film without pressure",
    SCHUR: "Fischer–Burmeister–Newton–Schur, from a full film without pressure",
    DEFAULT: "the default: Newton's method on an active set, from coarse grids to fine",
}
"""Of the methods."""


MEANING: Mapping[State, str] = {
    State.CONVERGED: "an answer within what its judge allows",
    State.SLOW: f"the same, after more than {SLOW} iterations",
    **ALWAYS,
}


@dataclass(frozen=True, kw_only=True)
class Spot(spots_of.Spot):
    """What became of one question; None where there was no answer. ``error`` may be as large as ``allowed``."""

    error: float | None = None
    allowed: float


def tried(probe: Probe) -> Spot:
    """Put a question and judge the answer; whatever else is raised is wrong."""
    spot = partial(Spot, group=probe.group, row=probe.row, column=probe.column, allowed=probe.bound)
    cpu = time.process_time()
    try:
        found = probe.ask()
    except Exception as error:  # a question must end in an answer or in an error of the project's, and is told if not
        spent = time.process_time() - cpu
        known = isinstance(error, InputError | ConvergenceError)
        if known and probe.expected == REFUSED:
            state = State.REFUSED
        else:
            state = State.STALLED if isinstance(error, ConvergenceError) else State.WRONG
        message = str(error) if known else f"{type(error).__name__}: {error}"
        return spot(state=state, iterations=getattr(error, "iterations", None), cpu_s=spent, message=message)
    spent = time.process_time() - cpu
    finite = float(found.error) if np.isfinite(found.error) else None
    if probe.expected == REFUSED or finite is None or finite > probe.bound:
        wanted = "none exists" if probe.expected == REFUSED else f"off by {found.error:.2g}, allowed {probe.bound:.2g}"
        message = f"an answer: {wanted}"
        return spot(state=State.WRONG, iterations=found.iterations, error=finite, cpu_s=spent, message=message)
    state = State.SLOW if found.iterations > SLOW else State.CONVERGED
    return spot(state=state, iterations=found.iterations, error=finite, cpu_s=spent)


def methods(most: int) -> Iterator[Probe]:
    """The parabolic slider by all three methods, from 100 nodes to ``most``, judged by its exact load."""
    from rom.cavitation.exact import exact  # numba is slow to import

    known = {(theta, beta): exact(slider(theta, liquid(beta))).load for theta in THETAS for beta in MODULI}
    for method, solver in {SWITCH: _switch, SCHUR: _schur, DEFAULT: _default}.items():
        solver(1.0, 1.0, FEWEST)  # compiled before it is timed
        for theta in THETAS:
            for beta in MODULI:
                for nodes in sizes(most):

                    def ask(
                        solver: Callable[[float, float, int], tuple[int, float]] = solver,
                        theta: float = theta,
                        beta: float = beta,
                        nodes: int = nodes,
                    ) -> Answer:
                        iterations, load = solver(theta, beta, nodes)
                        return Answer(iterations=iterations, error=off(load, known[theta, beta]))

                    yield Probe(
                        group=method,
                        row=f"θ = {theta:g}",
                        column=f"{beta:g} GPa, {nodes}",
                        ask=ask,
                        bound=bound(nodes),
                    )


def sizes(most: int) -> list[int]:
    """Decades from the fewest nodes."""
    decades = round(np.log10(most // FEWEST)) if most >= FEWEST else -1
    return [FEWEST * 10**number for number in range(decades + 1) if FEWEST * 10**number <= most]


def _switch(theta: float, beta: float, nodes: int) -> tuple[int, float]:
    from rom.cavitation.switch import LIMIT, switched

    found = switched(slider(theta, liquid(beta)), nodes, limit=min(LIMIT, WORK // nodes))
    return found.iterations, found.load


def _schur(theta: float, beta: float, nodes: int) -> tuple[int, float]:
    from rom.cavitation.discretise import faces, network
    from rom.cavitation.fischer_burmeister import fischer_burmeister
    from rom.cavitation.grid import grid
    from scripts.cavitation_scenes import UNIT

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
    found = fischer_burmeister(net, problem, pressure_unit=UNIT)
    return found.iterations, float((cells.areas * found.state.pressure).sum())


def _default(theta: float, beta: float, nodes: int) -> tuple[int, float]:
    from rom.cavitation.solve import solve

    found = solve(slider(theta, liquid(beta)), (nodes, 1))
    return sum(level.iterations for level in found.levels), found.levels[-1].load


@dataclass(frozen=True, kw_only=True)
class CavitationFamily:
    """The slider by three methods, and what else the default solver is tried on."""

    resolution: int = MOST
    resolution_meaning: str = "most nodes along the slider"

    def make(self, *, resolution: int, out: Path, processes: int, scratch: Path) -> Made:  # noqa: ARG002
        """Try everything, one after the other: CPU times are to be compared."""
        if not FEWEST <= resolution <= MOST:
            raise InputError(f"--resolution: got {resolution}; the slider takes {FEWEST} to {MOST} nodes")
        asked = [*methods(resolution), *probes()]
        spots: list[Spot] = []
        with progress_bar(len(asked)) as advance:
            for probe in asked:
                advance(len(spots), f"{probe.group}: {probe.row}, {probe.column}")
                spots.append(tried(probe))
        groups = in_groups(spots)
        return Made(
            entries=entries_of("cavitation", resolution, spots, told(spots)),
            columns=columns_of(spots, ("error", "allowed")),
            table=table_of(groups),
            template="stability_cavitation.html.j2",
            page={
                "methods": {NAMES[name]: in_rows(groups[name]) for name in NAMES},
                "moduli": [f"{beta:g} GPa" for beta in MODULI],
                "nodes": [f"1e{round(np.log10(nodes))}" for nodes in sizes(resolution)],
                "probes": {name: in_rows(found) for name, found in groups.items() if name not in NAMES},
                "states": [(state, MEANING[state], count(spots, state)) for state in State],
                "told": told(spots),
                "bound": f"{SECOND_ORDER:g} (cell/length)² + {FLOOR:g}",
                "limit": f"3000 steps, or {WORK:g} steps times nodes",
            },
        )


def told(spots: Sequence[Spot]) -> list[str]:
    """What a reader should know, in words."""
    lines = []
    for method in NAMES:
        own = [spot for spot in spots if spot.group == method]
        good = [spot for spot in own if spot.state in (State.CONVERGED, State.SLOW)]
        if not good:
            continue
        most, worst = max(spot.iterations or 0 for spot in good), max(spot.error or 0.0 for spot in good)
        name = NAMES[method][0].upper() + NAMES[method][1:]
        lines.append(
            f"{name}: {len(good)} of {len(own)} sliders right, {count(own, State.SLOW)} of "
            f"these slowly, {count(own, State.STALLED)} stalled, {count(own, State.WRONG)} wrong; "
            f"at most {most} iterations where right, loads off by at most {worst:.1e}, "
            f"{sum(spot.cpu_s for spot in own):.2g} s in all."
        )
    others = [spot for spot in spots if spot.group not in NAMES]
    if others:
        right = sum(spot.state in (State.CONVERGED, State.SLOW, State.REFUSED) for spot in others)
        lines.append(f"{right} of {len(others)} other questions to the default solver end as they must.")
    return lines + [
        f"{spot.state.capitalize()}: {spot.group}: {spot.row}, {spot.column}: {spot.message}"
        for spot in others + [spot for spot in spots if spot.group == DEFAULT]
        if spot.state in (State.STALLED, State.WRONG)
    ]


CAVITATION = CavitationFamily()
