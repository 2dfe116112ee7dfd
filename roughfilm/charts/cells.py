"""The chart of the flow factor of a gap with an exact solution, by every method of this project and by reynoldsflow."""

import time
from collections.abc import Callable
from functools import partial

import numpy as np

from roughfilm.charts.family import MAX_RUNS_S, Ask, ChartFamily, Measured, Peer, ReferenceValue, fastest
from roughfilm.charts.peer_runs import CELLS
from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.writing.scratch import scratch_directory
from roughfilm.figures.view import Style
from roughfilm.rom.homogenization.cell import solve_cell
from roughfilm.rom.homogenization.conductance import FaceRule, faces
from roughfilm.rom.homogenization.exact import nearly_smooth, self_dual
from roughfilm.rom.homogenization.flow_factors import flow_factors
from roughfilm.rom.homogenization.patir_cheng import patir_cheng

NODES = (32, 64, 128, 256, 512, 1024)
"""Numbers of nodes along a side of the period."""

MEAN_NODES = 256
"""Number of nodes along a side for which means of the smooth periodic h are exact to round-off."""

WAVES = 12
"""Number of periods of the shortest wave of ln h along an axis."""

HURST = 0.8
"""Hurst exponent of ln h."""

ROUGHNESS = 0.5
"""Rms of ln h."""

SEED = 20071
"""Seed of the random ln h."""

SOLVER_ERROR_FRACTION = 0.01
"""Allowed error of an iterative solver, divided by the discretisation error of its grid."""

SQUARE = (1.0, 1.0)
"""Spacing of the nodes in x and y, of which only the ratio matters."""

STYLES = {
    "nearly_smooth": Style(colour="#7f7f7f", marker="s"),
    "patir_cheng": Style(colour="#5aae61", marker="D"),
    "cell": Style(colour="#2166ac", marker="o"),
    "flow_factors": Style(colour="#b2182b", marker="^"),
}


def rough_gap(nodes: int) -> Array:
    """The gap h of a random self-affine ln h, shape (nodes, nodes), for which A = exp <ln h³> is exact.

    ln h = Σ a (cos(mX + nY) + cos(mY - nX)) over odd m + n is unchanged by a rotation of 90°, and becomes −ln h
    after a shift by half a period along both axes, as :func:`roughfilm.rom.homogenization.exact.self_dual` requires.
    """
    random = np.random.default_rng(SEED)
    both = np.arange(-WAVES, WAVES + 1)
    amplitudes = np.zeros((both.size, both.size))  # of exp(i(mX + nY)), by m and n
    for m in range(1, WAVES + 1):
        for n in range(1 - m % 2, WAVES + 1, 2):
            amplitude = random.standard_normal() * np.hypot(m, n) ** -(1 + HURST)
            amplitudes[WAVES + m, WAVES + n] = amplitudes[WAVES - n, WAVES + m] = amplitude
    wave = np.exp(2j * np.pi * np.outer(np.arange(nodes) / nodes, both))
    log = (wave @ amplitudes @ wave.T).real
    return np.asarray(np.exp(ROUGHNESS / np.sqrt((amplitudes**2).sum() / 2) * log))


def truth() -> ReferenceValue:
    """The exact flow factor φ = A/<h>³ with its uncertainty and source."""
    h = rough_gap(MEAN_NODES)
    return ReferenceValue(
        value=self_dual(h) / float(h.mean()) ** 3,
        uncertainty=1e-12,
        source="exact: A = exp ⟨ln h³⟩, as the gap is like its own inverse (Keller 1964, Dykhne 1971)",
    )


METHODS: dict[str, tuple[Callable[[Array], float], float]] = {
    "nearly_smooth": (lambda h: nearly_smooth(h, SQUARE).pressure[0, 0], 3e-7),
    "patir_cheng": (lambda h: patir_cheng(h, SQUARE).pressure[0], 3e-6),
    "cell": (lambda h: solve_cell(h, SQUARE).factors.pressure[0, 0], 3e-6),
    "flow_factors": (lambda h: flow_factors(h, SQUARE).factors.pressure[0, 0], 3e-6),
}
"""Function that computes A₁₁, and CPU seconds per node, by method."""


def by(method: Callable[[Array], float], nodes: int) -> Measured:
    """The flow factor φ₁₁ by one method of this project on ``nodes`` nodes along a side, and its CPU time."""
    h = rough_gap(nodes)
    started = time.process_time()
    pressure = float(method(h))
    return Measured(value=pressure / float(h.mean()) ** 3, cpu_s=time.process_time() - started)


def by_reynoldsflow(nodes: int) -> Measured:
    """The flow factor φ₁₁ by reynoldsflow, and its CPU time, at the loosest sufficient tolerance.

    The tolerance is sufficient if the error of the solver is at most ``SOLVER_ERROR_FRACTION`` of that of the grid.

    Raises
    ------
    UnavailableError
        If reynoldsflow is not available.
    ConvergenceError
        If the program fails.
    """
    h = rough_gap(nodes)
    h /= h.mean()
    right = np.diag(solve_cell(h, SQUARE, rule=FaceRule.HARMONIC, tolerance=1e-11).factors.pressure)
    problem = {
        "right": right.tolist(),
        "error": SOLVER_ERROR_FRACTION * abs(float(right[0]) / truth().value - 1),
        "repeats": 3,
    }
    with scratch_directory() as place:
        parts = faces(h)
        for name in ("east", "north", "drag"):
            np.save(place / f"{name}.npy", getattr(parts, name))
        np.save(place / "gap.npy", h)
        answer = CELLS.run("cells.py", "run_reynoldsflow:petsc-cg.hypre", place, problem=problem)
    return Measured(
        value=float(answer["pressure"][0][0]),
        cpu_s=answer["cpu_s"],
        details={name: answer[name] for name in ("version", "tolerance", "residual")},
    )


def flow_factors_family() -> ChartFamily:
    """The chart family of the flow factor φ₁₁ of the rough gap."""
    asks = [
        Ask(
            solver=name,
            resolution=nodes,
            cost=max(2 * cost * nodes**2, min(7 * cost * nodes**2, MAX_RUNS_S)),
            measure=partial(fastest, partial(by, method, nodes)),
        )
        for name, (method, cost) in METHODS.items()
        for nodes in NODES
    ]
    return ChartFamily(
        name="flow factors",
        work=f"The pressure flow factor φ = A/⟨h⟩³ of an open rough gap: ln h is self-affine (Hurst {HURST:g}, rms "
        f"{ROUGHNESS:g}, waves down to 1/{WAVES} of the period).",
        quantity="flow factor",
        unit="1",
        resolution_meaning="nodes along a side of the period",
        truth=truth,
        truth_cost=1.0,
        own=asks,
        peers=(
            Peer(
                name="reynoldsflow",
                settings="periodic, conjugate gradients of PETSc under BoomerAMG, at the loosest tolerance that is "
                "within a hundredth of its grid's own error; A alone, by two directions",
                costs={nodes: 1 + 2e-4 * nodes**2 for nodes in NODES[1:-1]},
                measure=by_reynoldsflow,
                absent=CELLS.absent,
            ),
        ),
        styles=STYLES,
    )
