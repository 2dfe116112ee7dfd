"""Flow factors of a rough gap whose factors are known exactly, by every way of this project and by reynoldsflow."""

import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from roughfilm.charts.family import ENOUGH_S, Ask, Family, Measured, Truth, fastest
from roughfilm.charts.peer_runs import CELLS, peer
from roughfilm.contact.foundation.arrays import Array
from roughfilm.figures.view import Style

NODES = (32, 64, 128, 256, 512, 1024)
"""Along a side of the period."""

MEAN_NODES = 256
"""Enough for means over the period that are exact to round-off: h is smooth and periodic."""

WAVES, HURST, ROUGHNESS, SEED = 12, 0.8, 0.5, 20071
"""The shortest wave of ln h along an axis, in parts of the period; rms of ln h."""

PART = 0.01
"""Of what its grid is off by: so near every iterative solver is to come to what its own grid tells."""

STYLES = {
    "nearly_smooth": Style(colour="#7f7f7f", marker="s"),
    "patir_cheng": Style(colour="#5aae61", marker="D"),
    "cell": Style(colour="#2166ac", marker="o"),
    "flow_factors": Style(colour="#b2182b", marker="^"),
}


def rough_gap(nodes: int) -> Array:
    """H on so many nodes along a side, of a random self-affine ln h, m; A = exp <ln h³>, exactly.

    ln h = Σ a (cos(mX + nY) + cos(mY - nX)) over odd m + n looks the same turned by 90°, and shifted by half a period
    along both axes it is −ln h: what :func:`roughfilm.rom.homogenization.exact.self_dual` asks for.
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


def truth() -> Truth:
    """φ = A/<h>³."""
    from roughfilm.rom.homogenization.exact import self_dual

    h = rough_gap(MEAN_NODES)
    return Truth(
        value=self_dual(h) / float(h.mean()) ** 3,
        uncertainty=1e-12,
        source="exact: A = exp ⟨ln h³⟩, as the gap is like its own inverse (Keller 1964, Dykhne 1971)",
    )


def _nearly_smooth(h: Array) -> float:
    from roughfilm.rom.homogenization.exact import nearly_smooth

    return float(nearly_smooth(h, (1.0, 1.0)).pressure[0, 0])


def _patir_cheng(h: Array) -> float:
    from roughfilm.rom.homogenization.patir_cheng import patir_cheng

    return float(patir_cheng(h, (1.0, 1.0)).pressure[0])


def _cell(h: Array) -> float:
    from roughfilm.rom.homogenization.cell import solve_cell

    return float(solve_cell(h, (1.0, 1.0)).factors.pressure[0, 0])


def _flow_factors(h: Array) -> float:
    from roughfilm.rom.homogenization.flow_factors import flow_factors

    return float(flow_factors(h, (1.0, 1.0)).factors.pressure[0, 0])


WAYS: dict[str, tuple[Callable[[Array], float], float]] = {
    "nearly_smooth": (_nearly_smooth, 3e-7),
    "patir_cheng": (_patir_cheng, 3e-6),
    "cell": (_cell, 3e-6),
    "flow_factors": (_flow_factors, 3e-6),
}
"""How each finds A₁₁, and CPU seconds a node."""


def by(way: Callable[[Array], float], nodes: int) -> Measured:
    """φ₁₁ by one way of this project."""
    h = rough_gap(nodes)
    started = time.process_time()
    found = way(h)
    return Measured(value=found / float(h.mean()) ** 3, cpu_s=time.process_time() - started)


def by_reynoldsflow(nodes: int) -> Measured:
    """φ₁₁ by reynoldsflow at the loosest tolerance that is good enough for the grid."""
    from roughfilm.rom.homogenization.cell import solve_cell
    from roughfilm.rom.homogenization.conductance import FaceRule, faces

    h = rough_gap(nodes)
    h /= h.mean()
    right = np.diag(solve_cell(h, (1.0, 1.0), rule=FaceRule.HARMONIC, tolerance=1e-11).factors.pressure)
    asked = {
        "right": right.tolist(),
        "error": PART * abs(float(right[0]) / truth().value - 1),
        "repeats": 3,
    }
    with TemporaryDirectory(prefix="roughfilm-") as place:
        parts = faces(h)
        for name in ("east", "north", "drag"):
            np.save(Path(place) / f"{name}.npy", getattr(parts, name))
        np.save(Path(place) / "gap.npy", h)
        found = CELLS.run("cells.py", "run_reynoldsflow:petsc-cg.hypre", Path(place), asked=asked)
    return Measured(
        value=float(found["pressure"][0][0]),
        cpu_s=found["cpu_s"],
        told={name: found[name] for name in ("version", "tolerance", "residual")},
    )


def flow_factors_family() -> Family:
    """φ₁₁ of the rough gap."""
    asks = [
        Ask(
            solver=name,
            resolution=nodes,
            cost=max(2 * cost * nodes**2, min(7 * cost * nodes**2, ENOUGH_S)),
            measure=partial(fastest, partial(by, way, nodes)),
        )
        for name, (way, cost) in WAYS.items()
        for nodes in NODES
    ]
    return Family(
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
            peer(
                CELLS,
                "reynoldsflow",
                "periodic, conjugate gradients of PETSc under BoomerAMG, at the loosest tolerance that is within a "
                "hundredth of its grid's own error; A alone, by two directions",
                {nodes: 1 + 2e-4 * nodes**2 for nodes in NODES[1:-1]},
                by_reynoldsflow,
            ),
        ),
        styles=STYLES,
    )
