"""The project's own: ``cell`` on the gap's grid alone, ``factors`` with error bars from coarser ones; both with e."""

from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.rom.homogenization.cell import solve_cell
from roughfilm.rom.homogenization.flow_factors import flow_factors

NAME, TOLERANCES = "roughfilm", (0.0,)


def solver(way):
    kind, _, tolerance = way.partition(" ")
    asked = {"tolerance": float(tolerance)} if tolerance else {}

    def solve(case, _tolerance):
        try:
            found = (solve_cell if kind == "cell" else flow_factors)(case.gap, (1.0, 1.0), **asked)
        except ConvergenceError as error:
            raise ArithmeticError(str(error)) from error
        factors = found.factors
        answer = {"iterations": found.iterations, "residual": found.residual}
        if kind == "factors":
            bar = found.uncertainty.pressure
            answer["uncertainty"] = max(bar[i, i] / factors.pressure[i, i] for i in (0, 1))
        return {"pressure": factors.pressure.tolist(), "shear": factors.shear.tolist(), **answer}

    return solve
