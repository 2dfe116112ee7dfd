"""The film of constant viscosity that belongs to a film whose viscosity grows with pressure.

With dq = (η0/η) dp, the flow h³/(12η) ∂p/∂x of an incompressible film is h³/(12η0) ∂q/∂x: q is the pressure of the same
film at constant viscosity. As p grows without limit, q tends to ∫ η0/η dp from 0 to infinity, which is 1/α for Barus'
law. A film that reaches this limit at constant viscosity has no steady solution. Compression shifts the limit.
"""

import math
from dataclasses import replace

import numpy as np

from roughfilm.rom.cavitation.problem import Problem, unchanging


def reduced_pressure(problem: Problem, pressure: float) -> float:
    """Return q = ∫ η0/η dp from 0 to ``pressure``, Pa; both may be infinite."""
    from scipy.integrate import quad  # slow to import

    slope = -float(problem.piezoviscosity.fluidity(np.zeros(1), problem.viscosity)[1][0])
    if slope <= 0:
        return pressure

    def fluidity(changes: float) -> float:
        return float(problem.piezoviscosity.fluidity(np.array([changes / slope]), problem.viscosity)[0][0])

    return float(quad(fluidity, 0, pressure * slope)[0]) / slope


def pressure_limit(problem: Problem) -> float:
    """Return the limit of q as the pressure grows, Pa; infinite where viscosity does not grow with pressure."""
    return reduced_pressure(problem, math.inf)


def at_constant_viscosity(problem: Problem) -> Problem:
    """Return the film of constant density and viscosity whose pressure is q."""
    ends = problem.ends
    reduced = replace(
        ends,
        inlet=None if ends.inlet is None else reduced_pressure(problem, ends.inlet),
        outlet=reduced_pressure(problem, ends.outlet),
        sides=None
        if ends.sides is None
        else (reduced_pressure(problem, ends.sides[0]), reduced_pressure(problem, ends.sides[1])),
    )
    return replace(unchanging(problem), ends=reduced)
