"""Conjugate gradients preconditioned by algebraic multigrid of PyAMG; the way is its coarsening."""

import numpy as np
import pyamg
from scipy.sparse.linalg import cg

NAME, TOLERANCES = "pyamg", (1e-3, 1e-4, 1e-5, 1e-6, 1e-8, 1e-10)


def solver(way):
    set_up = {"ruge_stuben": pyamg.ruge_stuben_solver, "aggregation": pyamg.smoothed_aggregation_solver}[way]

    def solve(case, tolerance):
        matrix = case.matrix.tocsr()
        cycle = set_up(matrix).aspreconditioner(cycle="V")
        found = [cg(matrix, source, rtol=tolerance, M=cycle, maxiter=500) for source in case.sources.T]
        if any(failed for _, failed in found):
            raise ArithmeticError(f"the residual does not come down to {tolerance:g} in 500 iterations")
        return np.stack([chi for chi, _ in found], axis=1)

    return solve
