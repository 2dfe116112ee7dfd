"""reynoldsflow in its periodic mode, once for each direction; the way is its solver. It has A but no B.

Its conductances are harmonic means. It drives flow along the first axis only, so that the gap is turned for the second.
"""

import warnings

import numpy as np
from reynoldsflow.transport import prepare_fluid_problem

NAME, RULE, TOLERANCES = "reynoldsflow", "harmonic", (1e-3, 1e-4, 1e-5, 1e-6, 1e-8, 1e-10, 1e-12)


def solver(way):
    def solve(_case, gap, tolerance):
        columns, residuals = [], []
        for axis in (0, 1):
            turned = np.ascontiguousarray(gap if axis == 0 else gap.T)
            try:
                problem = prepare_fluid_problem(turned, boundary_mode="periodic")
                _, _, flux, found = problem.solve_with_diagnostics(turned, solver=way, rtol=tolerance or 1e-12)
            except (RuntimeError, ValueError) as error:
                raise ArithmeticError(str(error)) from error
            mean = flux.mean(axis=(0, 1))
            columns.append(mean if axis == 0 else mean[::-1])
            residuals.append(found.relative_residual)
        return np.stack(columns, axis=1).tolist(), max(residuals)

    return solve
