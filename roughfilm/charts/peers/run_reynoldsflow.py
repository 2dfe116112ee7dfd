"""reynoldsflow in its periodic mode, once for each direction; the way is its solver. It has A but no B.

Its conductances are harmonic means. It drives flow along the first axis only, so that the gap is turned for the second.
"""

import numpy as np
from reynoldsflow.transport import prepare_fluid_problem

NAME, TOLERANCES = "reynoldsflow", (1e-3, 1e-4, 1e-5, 1e-6, 1e-8, 1e-10, 1e-12)


def solver(way):
    def solve(case, tolerance):
        columns, residuals = [], []
        for axis in (0, 1):
            turned = np.ascontiguousarray(case.gap if axis == 0 else case.gap.T)
            try:
                problem = prepare_fluid_problem(turned, boundary_mode="periodic")
                _, _, flux, found = problem.solve_with_diagnostics(turned, solver=way, rtol=tolerance)
            except (RuntimeError, ValueError) as error:
                raise ArithmeticError(str(error)) from error
            mean = flux.mean(axis=(0, 1))
            columns.append(mean if axis == 0 else mean[::-1])
            residuals.append(found.relative_residual)
        return {"pressure": np.stack(columns, axis=1).tolist(), "residual": max(residuals)}

    return solve
