"""Solve the cell problems of one gap by one solver in this process: cells.py SOLVER CASE.npz ASKED.json RESULT.json.

The case has the gap and the conductances of the faces to the next node, ``east`` and ``north``, on square pixels; all
but reynoldsflow, which makes its own, solve with these. What is timed begins with the matrix and ends with χ₁ and χ₂.
"""

import importlib
import json
import resource
import sys
import time
from importlib import metadata
from pathlib import Path

import numpy as np
from scipy.sparse import csc_matrix
from scipy.sparse.csgraph import connected_components

SMALL = 64


class Case:
    """The periodic network of one gap: K over its open nodes, one node of each piece held at 0, and sources b₁, b₂."""

    def __init__(self, east, north):
        self.east, self.north = east, north
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
        held = strongest[np.unique(piece[strongest], return_index=True)[1]]
        free = diagonal > 0
        free[held] = False
        self.free = np.flatnonzero(free)
        whole = csc_matrix((diagonal, (np.arange(count),) * 2), shape=(count, count)) - links
        self.matrix = whole[self.free][:, self.free].tocsc()
        self.matrix.sort_indices()
        fluxes = (east, north)
        self.sources = np.stack([(flux - np.roll(flux, 1, axis=i)).ravel() for i, flux in enumerate(fluxes)], axis=1)

    def judge(self, chi):
        """A of the gap's units and the largest residual, of χ₁ and χ₂ on the free nodes, shape (free, 2)."""
        fields = np.zeros((self.east.size, 2))
        fields[self.free] = chi
        fields = fields.T.reshape(2, *self.east.shape)
        along = [np.roll(field, -1, axis=0) - field + one for field, one in zip(fields, (1, 0), strict=True)]
        across = [np.roll(field, -1, axis=1) - field + one for field, one in zip(fields, (0, 1), strict=True)]
        pressure = [
            [float((self.east * along[i] * along[j] + self.north * across[i] * across[j]).mean()) for j in (0, 1)]
            for i in (0, 1)
        ]
        left = self.sources[self.free] - self.matrix @ chi
        return pressure, float((np.linalg.norm(left, axis=0) / np.linalg.norm(self.sources, axis=0)).max())


def attempt(solve, case, gap, tolerance):
    started = time.process_time()
    try:
        found = solve(case, gap, tolerance)
    except ArithmeticError as error:
        return {"tolerance": tolerance, "failed": str(error)}
    spent = time.process_time() - started
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
    pressure, residual = found if isinstance(found, tuple) else case.judge(found)
    return {"tolerance": tolerance, "cpu_s": spent, "pressure": pressure, "residual": residual, "peak_bytes": peak}


def off(run, right):
    """Of A₁₁ and A₂₂, over what is right."""
    if "failed" in run:
        return np.inf
    return max(abs(run["pressure"][i][i] / right[i] - 1) for i in (0, 1))


def main():
    name, case, asked, result = sys.argv[1:]
    arrays, asked = np.load(case), json.loads(Path(asked).read_text())
    program, _, way = name.partition(":")
    module = importlib.import_module(program)
    solve, right = module.solver(way), asked["right"][module.RULE]
    step = max(1, arrays["gap"].shape[0] // SMALL)
    attempt(solve, Case(arrays["east"][::step, ::step], arrays["north"][::step, ::step]), arrays["gap"][::step, ::step], 1e-3)
    problem = Case(arrays["east"], arrays["north"])
    for tolerance in module.TOLERANCES:
        found = attempt(solve, problem, arrays["gap"], tolerance)
        if off(found, right) <= asked["error"]:
            break
    if "failed" not in found:
        again = [attempt(solve, problem, arrays["gap"], found["tolerance"]) for _ in range(asked["repeats"] - 1)]
        found["cpu_s"] = min(run["cpu_s"] for run in [found, *again])
        found["error"] = off(found, right)
    Path(result).write_text(json.dumps({"version": metadata.version(module.NAME), **found}))


if __name__ == "__main__":
    main()
