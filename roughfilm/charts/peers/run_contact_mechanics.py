"""ContactMechanics: conjugate gradients of Polonsky and Keer, by itself or under a hardness, from the forces before."""

import numpy as np
from ContactMechanics import PeriodicFFTElasticHalfSpace
from ContactMechanics.Optimization import constrained_conjugate_gradients
from SurfaceTopography import Topography

NAME = "ContactMechanics"
MOST_ITERATIONS = 20000


def prepare(heights, problem):
    unit = problem["spacing"][0]
    sides = tuple(n * step / unit for n, step in zip(heights.shape, problem["spacing"], strict=True))
    scaled = np.ascontiguousarray(heights / unit)
    pixel = problem["spacing"][1] / unit
    half_space = PeriodicFFTElasticHalfSpace(heights.shape, 1.0, sides)
    surface = Topography(scaled, sides)

    def solve(load, tolerance, start):
        found = constrained_conjugate_gradients(
            half_space,
            surface,
            hardness=None if problem["hardness"] is None else problem["hardness"] * pixel,
            external_force=load * sides[0] * sides[1],
            initial_forces=None if start is None else -start[1] * (load / start[0]),
            pentol=tolerance * scaled.std(),
            forcetol=tolerance * pixel,
            thermotol=tolerance,
            maxiter=MOST_ITERATIONS,
        )
        if not found.success:
            raise ArithmeticError(found.message)
        forces = np.asarray(found.jac)
        return forces / pixel, int(found.nit), (load, forces)

    return solve
