"""The project's own solver."""

import math

from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.contact.mechanics.press import Press

NAME = "roughfilm"
MODULUS = 2.0**37
"""Pa; a power of two, so that a pressure over it is the same number."""


def prepare(heights, problem):
    hardness = math.inf if problem["hardness"] is None else problem["hardness"] * MODULUS
    press = Press(heights, tuple(problem["spacing"]), MODULUS, hardness=hardness, threads=problem["threads"])

    def solve(load, tolerance, start):
        try:
            found = press.at(load * MODULUS, tolerance=tolerance, start=start)
        except ConvergenceError as error:
            raise ArithmeticError(str(error)) from error
        return found.pressure / MODULUS, found.iterations, found

    return solve
