"""Solve the cell problems of one gap by one solver in this process: cells.py SOLVER FOLDER ASKED.json RESULT.json.

The folder has the gap and its faces of the linear rule on square pixels: ``gap.npy``, ``east.npy``, ``north.npy`` and
``drag.npy``. What is timed begins with the matrix, for reynoldsflow and the project's own with the gap, and ends with
χ₁ and χ₂, for these two with A.
"""

import importlib
import json
import sys
import time
from functools import cached_property
from importlib import metadata
from pathlib import Path

import numpy as np
from scipy.sparse import csc_matrix
from scipy.sparse.csgraph import connected_components

SMALL_NODES = 64
"""Nodes along a side of the first small problem."""

MAX_REPEATS_S = 5.0
"""CPU seconds after which nothing is repeated."""

FACES = ("east", "north", "drag")


class Case:
    """A gap and its periodic network: K over the open nodes, one node of each piece held at 0, and sources b₁, b₂."""

    def __init__(self, gap, faces):
        self.gap, self._faces = gap, faces

    @cached_property
    def matrix(self):
        return self._network[1]

    @cached_property
    def sources(self):
        """Of the free nodes, shape (free, 2)."""
        east, north, _ = self._faces
        both = [(flux - np.roll(flux, 1, axis=axis)).ravel() for axis, flux in enumerate((east, north))]
        return np.stack(both, axis=1)[self._network[0]]

    @cached_property
    def _network(self):
        """The free nodes, and K between them."""
        east, north, _ = self._faces
        count = east.size
        nodes = np.arange(count).reshape(east.shape)
        first = np.concatenate([nodes.ravel()] * 2)
        second = np.concatenate([np.roll(nodes, -1, axis=axis).ravel() for axis in (0, 1)])
        couplings = np.concatenate([east.ravel(), north.ravel()])
        linked = couplings > 0
        links = csc_matrix((couplings[linked], (first[linked], second[linked])), shape=(count, count))
        links = links + links.T
        diagonal = np.asarray(links.sum(axis=1)).ravel()
        _, piece = connected_components(links, directed=False)
        strongest = np.lexsort((-diagonal, piece))
        free = diagonal > 0
        free[strongest[np.unique(piece[strongest], return_index=True)[1]]] = False
        free = np.flatnonzero(free)
        matrix = (csc_matrix((diagonal, (np.arange(count),) * 2), shape=(count, count)) - links)[free][:, free].tocsc()
        matrix.sort_indices()
        return free, matrix

    def judge(self, chi):
        """A, B and the residual of χ₁ and χ₂ on the free nodes, shape (free, 2)."""
        east, north, drag = self._faces
        fields = np.zeros((east.size, 2))
        fields[self._network[0]] = chi
        fields = fields.T.reshape(2, *east.shape)
        along = [np.roll(field, -1, axis=0) - field + one for field, one in zip(fields, (1, 0), strict=True)]
        across = [np.roll(field, -1, axis=1) - field + one for field, one in zip(fields, (0, 1), strict=True)]
        pressure = [
            [float((east * along[i] * along[j] + north * across[i] * across[j]).mean()) for j in (0, 1)] for i in (0, 1)
        ]
        left = self.sources - self.matrix @ chi
        residual = float((np.linalg.norm(left, axis=0) / np.linalg.norm(self.sources, axis=0)).max())
        return {"pressure": pressure, "shear": [float((drag * one).mean()) for one in along], "residual": residual}


def small_case():
    """A smooth open gap that compiles and loads everything."""
    wave = np.cos(2 * np.pi * np.arange(SMALL_NODES) / SMALL_NODES)
    gap = 1 + 0.5 * np.outer(wave, wave)
    faces = [(gap**3 + np.roll(gap, -1, axis=axis) ** 3) / 2 for axis in (0, 1)]
    return Case(gap, (*faces, gap))


def memory(name):
    """Memory in bytes; getrusage would include the parent process."""
    lines = Path("/proc/self/status").read_text().splitlines()
    return next(int(line.split()[1]) * 1024 for line in lines if line.startswith(name))


def attempt(solve, case, tolerance):
    """Times and results of one solve; ``failed`` says why there is none."""
    Path("/proc/self/clear_refs").write_text("5")  # resets the peak
    before = memory("VmHWM")
    started = time.process_time()
    try:
        found = solve(case, tolerance)
    except ArithmeticError as error:
        return {"tolerance": tolerance, "failed": str(error)}
    spent = time.process_time() - started
    peak = memory("VmHWM")
    judged = found if isinstance(found, dict) else case.judge(found)
    return {"tolerance": tolerance, "cpu_s": spent, "peak_bytes": peak, "bytes_before": before, **judged}


def error_of(run, right):
    """The larger relative error of A₁₁ and A₂₂."""
    if "failed" in run:
        return np.inf
    return max(abs(run["pressure"][i][i] / right[i] - 1) for i in (0, 1))


def main():
    name, folder, asked, result = sys.argv[1:]
    folder, asked = Path(folder), json.loads(Path(asked).read_text())
    program, _, way = name.partition(":")
    module = importlib.import_module(program)
    solve, right = module.solver(way), asked["right"]
    attempt(solve, small_case(), module.TOLERANCES[0])
    mapped = "r" if module.NAME in ("roughfilm", "reynoldsflow") else None
    case = Case(np.load(folder / "gap.npy"), [np.load(folder / f"{name}.npy", mmap_mode=mapped) for name in FACES])
    if not mapped:
        assert case.matrix.shape[0] == len(case.sources)  # made before anything is timed
    for tolerance in module.TOLERANCES:
        found = attempt(solve, case, tolerance)
        if error_of(found, right) <= asked["error"]:
            break
    if "failed" not in found:
        runs = [found]
        while len(runs) < asked["repeats"] and sum(run["cpu_s"] for run in runs) < MAX_REPEATS_S:
            runs.append(attempt(solve, case, found["tolerance"]))
        found["cpu_s"] = min(run["cpu_s"] for run in runs)
        found["error"] = error_of(found, right)
    Path(result).write_text(json.dumps({"version": metadata.version(module.NAME), **found}))


if __name__ == "__main__":
    main()
