"""ASPHER: preconditioned conjugate gradients, from coarse grids to fine, in float32 first. It has no hardness.

For a series of loads this from nothing took less time than its plain solver from the load before.
"""

import aspher
import numpy as np

NAME = "aspher"


def prepare(heights, problem):
    points = heights.shape[0]
    gap = np.ascontiguousarray(heights.max() - heights).ravel()

    def solve(load, tolerance, _start):
        found = aspher.solve_nested(
            grid_size=points,
            gap=gap,
            p_nominal=load,
            domain_size=points * problem["spacing"][0],
            E_star=1.0,
            backend="periodic",
            precision="float_then_double",
            tol=tolerance,
        )
        if not found.converged:
            raise ArithmeticError(f"{found.status} {found.status_reason}")
        return found.pressure, int(found.iterations), None

    return solve
