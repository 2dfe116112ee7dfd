"""The velocities and the dissipation across a film, at the Gauss points of every node.

Arrays of points have the shape (nx, ny, points), those of nodes (nx, ny); functions write into their last arrays.
"""

from roughfilm.contact.foundation.compiled import compiled


@compiled
def profile(viscosity, steepness, points, weights, integrals, thickness, speed, gradient_x, gradient_y, drift, push, heating, softening, shear, fluidity, lever):  # type: ignore[no-untyped-def]  # fmt: skip  # noqa: E501
    """Write the velocities by sliding and by pressure over their means, the dissipation over its mean, and η_s.

    With F(ζ) = ∫ dζ/η and G(ζ) = ∫ ζ dζ/η from the sliding wall, the velocities are in proportion to 1 - F/F(1) and to
    G(1) F/F(1) - G, and the dissipation to ((η ∂u/∂z)² + (η ∂v/∂z)²)/η. ``steepness`` is dη/dT, and ``softening`` the
    derivative of ln η_s by the temperature of each point. Source: Dowson 1962.
    """
    nx, ny, size = viscosity.shape
    for i in range(nx):
        for j in range(ny):
            zeroth, first = 0.0, 0.0
            for m in range(size):
                fluidity[m] = 1.0 / viscosity[i, j, m]
                zeroth += weights[m] * fluidity[m]
                first += weights[m] * points[m] * fluidity[m]
            centre = first / zeroth
            for m in range(size):
                lever[m] = fluidity[m] * (centre - points[m])
            shear[i, j] = 1.0 / zeroth
            h = thickness[i, j]
            by_sliding = speed[i, j] / (h * zeroth)
            along, across = h * gradient_x[i, j], h * gradient_y[i, j]
            drifting, pushed, heated = 0.0, 0.0, 0.0
            for m in range(size):
                sliding, pressing = 0.0, 0.0
                for n in range(size):
                    sliding += integrals[m, n] * fluidity[n]
                    pressing += integrals[m, n] * lever[n]
                drift[i, j, m] = zeroth - sliding
                push[i, j, m] = pressing
                above = points[m] - centre
                softening[i, j, m] = weights[m] * steepness[i, j, m] * (fluidity[m] * fluidity[m] / zeroth)
                stress = along * above - by_sliding
                heating[i, j, m] = (stress * stress + across * across * above * above) * fluidity[m]
                drifting += weights[m] * drift[i, j, m]
                pushed += weights[m] * push[i, j, m]
                heated += weights[m] * heating[i, j, m]
            for m in range(size):
                drift[i, j, m] *= weights[m] / drifting
                push[i, j, m] *= weights[m] / pushed
                heating[i, j, m] = weights[m] * heating[i, j, m] / heated if heated > 0.0 else weights[m]


@compiled
def divide(sliding, pressing, across, drift, push, periodic_x, periodic_y, along, beside, backward):  # type: ignore[no-untyped-def]  # fmt: skip
    """Write the flows towards i + 1 and j + 1 of every point, with the mean profiles of both nodes of a face.

    Write too whether lubricant flows backward through a face towards i + 1, and return the largest size of a flow.
    """
    nx, ny, size = drift.shape
    largest = 0.0
    for i in range(nx):
        backward[i] = False
        after = i + 1 if i + 1 < nx else (0 if periodic_x else i)
        for j in range(ny):
            above = j + 1 if j + 1 < ny else (0 if periodic_y else j)
            c, p, v = 0.5 * sliding[i, j], 0.5 * pressing[i, j], 0.5 * across[i, j]
            for m in range(size):
                along[i, j, m] = c * (drift[i, j, m] + drift[after, j, m]) + p * (push[i, j, m] + push[after, j, m])
                beside[i, j, m] = v * (push[i, j, m] + push[i, above, m])
                largest = max(largest, abs(along[i, j, m]), abs(beside[i, j, m]))
                if along[i, j, m] < 0.0:
                    backward[i] = True
    return largest
