"""The project's own: ``cell`` on the gap's grid alone, ``factors`` with an error bar from coarser grids; e as well."""

from contact.errors import ConvergenceError
from rom.homogenization.cell import solve_cell
from rom.homogenization.flow_factors import flow_factors

NAME, RULE = "roughfilm", "linear"
TOLERANCES = (0.0,)


def solver(way):
    kind, _, tolerance = way.partition(" ")

    def solve(_case, gap, _tolerance):
        spacing = (1.0, 1.0)
        asked = {"tolerance": float(tolerance)} if tolerance else {}
        try:
            if kind == "cell":
                found = solve_cell(gap, spacing, **asked)
            else:
                found = flow_factors(gap, spacing, **asked)
        except ConvergenceError as error:
            raise ArithmeticError(str(error)) from error
        return found.factors.pressure.tolist(), found.residual

    return solve
