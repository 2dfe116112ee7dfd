"""Where films that cavitate converge: the default solver and two older algorithms against exact solutions."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.errors import InputError
from roughfilm.stability.form import BAD, GOOD, Judged, Map, Outcome, Spot, named, summed, tried
from roughfilm.stability.questions.cavitation import probes
from roughfilm.stability.questions.films import FLOOR, REFUSED, SECOND_ORDER, Answer, Probe, bound, liquid, off, slider
from roughfilm.terminal.console import progress_bar

MODULI = (0.05, 0.07, 0.3, 1.0, 10.0, 100.0)
"""β, GPa."""

THETAS = (0.05, 0.2, 0.4, 0.55, 0.8, 0.95, 1.0)
"""How full the inlet of the slider is."""

FEWEST, MOST = 100, 100_000
"""Nodes of the slider, and decades between."""

WORK = 30_000_000
"""The switch algorithm may take so many iterations times nodes, and at most 3000."""

SWITCH, SCHUR, DEFAULT = "switch", "fbns", "default"

NAMES = {
    SWITCH: "the switch algorithm of the thesis, from a full film without pressure",
    SCHUR: "Fischer–Burmeister–Newton–Schur, from a full film without pressure",
    DEFAULT: "the default: Newton's method on an active set, from coarse grids to fine",
}
"""Of the methods."""


def put(probe: Probe) -> Spot:
    """A question put and judged."""
    spot = partial(Spot, group=probe.group, row=probe.row, column=probe.column)

    def judged(found: Answer) -> Judged:
        right = bool(found.error <= probe.bound)
        return Judged(
            iterations=found.iterations,
            right=right,
            error=found.error,
            numbers={"allowed": probe.bound},
            message="" if right else f"off by {found.error:.2g}, allowed {probe.bound:.2g}",
        )

    return tried(spot, probe.ask, judged, refused=probe.expected == REFUSED)


def methods(most: int) -> Iterator[Probe]:
    """The parabolic slider by all three methods, from 100 nodes to ``most``, judged by its exact load."""
    from roughfilm.rom.cavitation.exact import exact  # numba is slow to import

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
    from roughfilm.rom.cavitation.reference.switch import MAX_STEPS, switched

    found = switched(slider(theta, liquid(beta)), nodes, limit=min(MAX_STEPS, WORK // nodes))
    return found.iterations, found.load


def _schur(theta: float, beta: float, nodes: int) -> tuple[int, float]:
    from roughfilm.rom.cavitation.discretise import faces, network
    from roughfilm.rom.cavitation.grid import grid
    from roughfilm.rom.cavitation.reference.fischer_burmeister import fischer_burmeister
    from roughfilm.stability.questions.films import UNIT

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
    from roughfilm.rom.cavitation.solve import solve

    found = solve(slider(theta, liquid(beta)), (nodes, 1))
    return sum(level.iterations for level in found.levels), found.levels[-1].load


@dataclass(frozen=True, kw_only=True)
class CavitationFamily:
    """The slider by three methods, and what else the default solver is tried on."""

    resolution: int = MOST
    resolution_meaning: str = "most nodes along the slider"

    def make(self, *, resolution: int, out: Path, processes: int, scratch: Path) -> Map:  # noqa: ARG002
        """Try everything, one after the other: CPU times are to be compared."""
        if not FEWEST <= resolution <= MOST:
            raise InputError(f"--resolution: got {resolution}; the slider takes {FEWEST} to {MOST} nodes")
        asked = [*methods(resolution), *probes()]
        spots: list[Spot] = []
        with progress_bar(len(asked)) as advance:
            for probe in asked:
                advance(len(spots), f"{probe.group}: {probe.row}, {probe.column}")
                spots.append(put(probe))
        return Map(
            family="cavitation",
            title="Films that cavitate",
            axes="The parabolic slider, h = 25.4 µm (1 + (2x/L − 1)²), L = 76.2 mm, 4.57 m/s, 39 mPa s: how full its "
            "inlet is (rows), bulk modulus and nodes (columns), by three methods; below θ = 0.5 there is no film, and "
            "no load. Then what else the default solver is asked.",
            judge="Every load of the slider by an exact solution that shares nothing with the solvers but the "
            f"lubricant: it may be off by {SECOND_ORDER:g} (cell/length)² + {FLOOR:g}, what a scheme of second order "
            "must keep; every other question by a judge of its own. The switch algorithm is stopped after 3000 steps, "
            f"or {WORK:g} steps times nodes. Iterations are those on all grids together.",
            resolution=resolution,
            resolution_meaning=self.resolution_meaning,
            spots=spots,
            told=told(spots),
        )


def told(spots: Sequence[Spot]) -> list[str]:
    """What a reader should know, in words."""
    lines = []
    for method, words in NAMES.items():
        own = [spot for spot in spots if spot.group == method]
        if good := [spot for spot in own if spot.outcome in GOOD]:
            most, worst = max(spot.iterations or 0 for spot in good), max(spot.error or 0.0 for spot in good)
            lines.append(
                f"{words[0].upper()}{words[1:]}: {summed(own)}; at most {most} iterations where right, loads off by at "
                f"most {worst:.1e}, {sum(spot.cpu_s for spot in own):.2g} s in all."
            )
    others = [spot for spot in spots if spot.group not in NAMES]
    if others:
        right = sum(spot.outcome in (*GOOD, Outcome.REFUSED) for spot in others)
        lines.append(f"{right} of {len(others)} other questions to the default solver end as they must.")
    return lines + named(others + [spot for spot in spots if spot.group == DEFAULT], *BAD)


CAVITATION = CavitationFamily()
