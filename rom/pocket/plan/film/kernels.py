"""Loops over the cells of a film in plan: values at their faces, momentum that leaves them, and long vectors.

Arrays at points across the film have the shape (nx, ny, points). The node (i, j) of a periodic grid has the cell of u
ahead of it along x, that of v ahead along y, and a corner of cells ahead along both.
"""

import numpy as np

from roughfilm.contact.foundation.compiled import compiled


@compiled
def face_values(u, v, below_u, below_v, first, thickness, rows, central, polynomial, upwind, known, faces):  # type: ignore[no-untyped-def]
    """Interpolate velocities to the faces of all cells.

    Parameters
    ----------
    u, v, below_u, below_v : velocities of the cells, and their integrals from Y = 0.
    first : the flow over film thickness of u and of v in amplitudes of the first polynomial, shape (2, nx, ny).
    thickness, rows, central : those of a sheet.
    polynomial : the first polynomial and its integral, shape (2, points).
    upwind : directions at u and v at nodes and at u and v at corners, 1 forward or 0, shape (4, nx, ny, points).
    known : whether the directions are given; if not they are determined.
    faces : u and v at nodes; u and v at corners; flows along y and x through the corners; flows that enter the cells of
        u and of v below a point, shape (8, nx, ny, points).

    Notes
    -----
    Along its own axis the flow of a velocity is interpolated, and its first amplitude follows from the film thickness
    at the node, so that a uniform flow remains one. The other amplitudes are interpolated themselves.
    """
    nx, ny, points = u.shape
    h_u, h_v, h = thickness[0], thickness[1], thickness[2]
    first_u, first_v, shape, below = first[0], first[1], polynomial[0], polynomial[1]
    ahead_x, around_x, ahead_y, around_y = rows[0, 0], rows[0, 1], rows[1, 0], rows[1, 1]
    for i in range(nx):
        i2, i1, ip, ipp = (i - 2) % nx, (i - 1) % nx, (i + 1) % nx, (i + 2) % nx
        left_x = ahead_x[i] / (ahead_x[i1] + ahead_x[i])
        for j in range(ny):
            j2, j1, jp, jpp = (j - 2) % ny, (j - 1) % ny, (j + 1) % ny, (j + 2) % ny
            left_y = ahead_y[j] / (ahead_y[j1] + ahead_y[j])
            e2, e1 = (h_u[i2, j] / h[i, j] - 1) * first_u[i2, j], (h_u[i1, j] / h[i, j] - 1) * first_u[i1, j]
            e0, ep = (h_u[i, j] / h[i, j] - 1) * first_u[i, j], (h_u[ip, j] / h[i, j] - 1) * first_u[ip, j]
            behind, ahead = rows[0, 2, i1], rows[0, 3, i]
            for m in range(points):
                back, fore = u[i1, j, m] + shape[m] * e1, u[i, j, m] + shape[m] * e0
                middle = left_x * back + (1 - left_x) * fore
                if not known:
                    upwind[0, i, j, m] = 1.0 if middle > 0 else 0.0
                forward = (1 + behind) * back - behind * (u[i2, j, m] + shape[m] * e2)
                backward = (1 + ahead) * fore - ahead * (u[ip, j, m] + shape[m] * ep)
                value = backward + upwind[0, i, j, m] * (forward - backward)
                faces[0, i, j, m] = central * middle + (1 - central) * value
            e2, e1 = (h_v[i, j2] / h[i, j] - 1) * first_v[i, j2], (h_v[i, j1] / h[i, j] - 1) * first_v[i, j1]
            e0, ep = (h_v[i, j] / h[i, j] - 1) * first_v[i, j], (h_v[i, jp] / h[i, j] - 1) * first_v[i, jp]
            behind, ahead = rows[1, 2, j1], rows[1, 3, j]
            for m in range(points):
                back, fore = v[i, j1, m] + shape[m] * e1, v[i, j, m] + shape[m] * e0
                middle = left_y * back + (1 - left_y) * fore
                if not known:
                    upwind[1, i, j, m] = 1.0 if middle > 0 else 0.0
                forward = (1 + behind) * back - behind * (v[i, j2, m] + shape[m] * e2)
                backward = (1 + ahead) * fore - ahead * (v[i, jp, m] + shape[m] * ep)
                value = backward + upwind[1, i, j, m] * (forward - backward)
                faces[1, i, j, m] = central * middle + (1 - central) * value
            behind, ahead = rows[1, 4, j], rows[1, 5, jp]
            for m in range(points):
                flow = (h_v[i, j] * v[i, j, m] + h_v[ip, j] * v[ip, j, m]) / 2
                if not known:
                    upwind[2, i, j, m] = 1.0 if flow > 0 else 0.0
                forward = (1 + behind) * u[i, j, m] - behind * u[i, j1, m]
                backward = (1 + ahead) * u[i, jp, m] - ahead * u[i, jpp, m]
                value = backward + upwind[2, i, j, m] * (forward - backward)
                faces[2, i, j, m] = central * (u[i, j, m] + u[i, jp, m]) / 2 + (1 - central) * value
                faces[4, i, j, m] = flow
            behind, ahead = rows[0, 4, i], rows[0, 5, ip]
            for m in range(points):
                flow = (h_u[i, j] * u[i, j, m] + h_u[i, jp] * u[i, jp, m]) / 2
                if not known:
                    upwind[3, i, j, m] = 1.0 if flow > 0 else 0.0
                forward = (1 + behind) * v[i, j, m] - behind * v[i1, j, m]
                backward = (1 + ahead) * v[ip, j, m] - ahead * v[ipp, j, m]
                value = backward + upwind[3, i, j, m] * (forward - backward)
                faces[3, i, j, m] = central * (v[i, j, m] + v[ip, j, m]) / 2 + (1 - central) * value
                faces[5, i, j, m] = flow
            next_x, next_y = ahead_x[ip] / (ahead_x[i] + ahead_x[ip]), ahead_y[jp] / (ahead_y[j] + ahead_y[jp])
            e1 = left_x * (h_u[i1, j] - h[i, j]) * first_u[i1, j] + (1 - left_x) * (h_u[i, j] - h[i, j]) * first_u[i, j]
            ep = next_x * (h_u[i, j] - h[ip, j]) * first_u[i, j]
            ep += (1 - next_x) * (h_u[ip, j] - h[ip, j]) * first_u[ip, j]
            for m in range(points):
                fore = h[ip, j] * (next_x * below_u[i, j, m] + (1 - next_x) * below_u[ip, j, m]) + below[m] * ep
                back = h[i, j] * (left_x * below_u[i1, j, m] + (1 - left_x) * below_u[i, j, m]) + below[m] * e1
                side = h_v[i, j] * below_v[i, j, m] + h_v[ip, j] * below_v[ip, j, m]
                side -= h_v[i, j1] * below_v[i, j1, m] + h_v[ip, j1] * below_v[ip, j1, m]
                faces[6, i, j, m] = around_y[j] * (fore - back) + ahead_x[i] / 2 * side
            e1 = left_y * (h_v[i, j1] - h[i, j]) * first_v[i, j1] + (1 - left_y) * (h_v[i, j] - h[i, j]) * first_v[i, j]
            ep = next_y * (h_v[i, j] - h[i, jp]) * first_v[i, j]
            ep += (1 - next_y) * (h_v[i, jp] - h[i, jp]) * first_v[i, jp]
            for m in range(points):
                fore = h[i, jp] * (next_y * below_v[i, j, m] + (1 - next_y) * below_v[i, jp, m]) + below[m] * ep
                back = h[i, j] * (left_y * below_v[i, j1, m] + (1 - left_y) * below_v[i, j, m]) + below[m] * e1
                side = h_u[i, j] * below_u[i, j, m] + h_u[i, jp] * below_u[i, jp, m]
                side -= h_u[i1, j] * below_u[i1, j, m] + h_u[i1, jp] * below_u[i1, jp, m]
                faces[7, i, j, m] = around_x[i] * (fore - back) + ahead_y[j] / 2 * side


@compiled
def momentum(u, v, faces, change_u, change_v, changes, thickness, rows, leaving):  # type: ignore[no-untyped-def]
    """The momentum that leaves each cell, to first order in changes; twice that of the flow if it is its own change.

    ``leaving`` has the shape (2, 2, nx, ny, points): of u and of v the momentum through the sides, and the velocity
    times the flow through the surfaces of constant Y.
    """
    nx, ny, points = u.shape
    h = thickness[2]
    ahead_x, around_x, ahead_y, around_y = rows[0, 0], rows[0, 1], rows[1, 0], rows[1, 1]
    for i in range(nx):
        i1, ip = (i - 1) % nx, (i + 1) % nx
        for j in range(ny):
            j1, jp = (j - 1) % ny, (j + 1) % ny
            for m in range(points):
                through = h[ip, j] * faces[0, ip, j, m] * changes[0, ip, j, m]
                through -= h[i, j] * faces[0, i, j, m] * changes[0, i, j, m]
                side = faces[2, i, j, m] * changes[4, i, j, m] + changes[2, i, j, m] * faces[4, i, j, m]
                side -= faces[2, i, j1, m] * changes[4, i, j1, m] + changes[2, i, j1, m] * faces[4, i, j1, m]
                leaving[0, 0, i, j, m] = 2 * around_y[j] * through + ahead_x[i] * side
                leaving[0, 1, i, j, m] = u[i, j, m] * changes[6, i, j, m] + change_u[i, j, m] * faces[6, i, j, m]
            for m in range(points):
                through = h[i, jp] * faces[1, i, jp, m] * changes[1, i, jp, m]
                through -= h[i, j] * faces[1, i, j, m] * changes[1, i, j, m]
                side = faces[3, i, j, m] * changes[5, i, j, m] + changes[3, i, j, m] * faces[5, i, j, m]
                side -= faces[3, i1, j, m] * changes[5, i1, j, m] + changes[3, i1, j, m] * faces[5, i1, j, m]
                leaving[1, 0, i, j, m] = 2 * around_x[i] * through + ahead_y[j] * side
                leaving[1, 1, i, j, m] = v[i, j, m] * changes[7, i, j, m] + change_v[i, j, m] * faces[7, i, j, m]


@compiled
def dot(one, other):  # type: ignore[no-untyped-def]
    """The sum of products; the libraries of linear algebra start threads for long vectors, which take CPU time."""
    total = 0.0
    for i in range(one.size):
        total += one[i] * other[i]
    return total


@compiled
def orthogonalise(directions, vector, projections, number):  # type: ignore[no-untyped-def]
    """Take the first ``number`` orthonormal directions out of a vector and append the normalised rest to them."""
    for k in range(number):
        part = 0.0
        for i in range(vector.size):
            part += directions[k, i] * vector[i]
        projections[k] = part
        for i in range(vector.size):
            vector[i] -= part * directions[k, i]
    rest = 0.0
    for i in range(vector.size):
        rest += vector[i] * vector[i]
    rest = np.sqrt(rest)
    projections[number] = rest
    scale = 1 / rest if rest > 0 else 0.0
    for i in range(vector.size):
        directions[number, i] = vector[i] * scale


@compiled
def rotate(projections, rotations, target, number):  # type: ignore[no-untyped-def]
    """Rotate column ``number`` of a Hessenberg matrix so that its last entry is zero, and the right-hand side with it.

    ``rotations`` are the cosines and sines of the columns before, to which those of this one are appended.
    """
    for k in range(number):
        cosine, sine = rotations[k, 0], rotations[k, 1]
        one, other = projections[k], projections[k + 1]
        projections[k], projections[k + 1] = cosine * one + sine * other, cosine * other - sine * one
    size = np.sqrt(projections[number] ** 2 + projections[number + 1] ** 2)
    cosine, sine = projections[number] / size, projections[number + 1] / size
    rotations[number, 0], rotations[number, 1] = cosine, sine
    projections[number], projections[number + 1] = size, 0.0
    target[number + 1] = -sine * target[number]
    target[number] *= cosine


@compiled
def combine(directions, weights, combined):  # type: ignore[no-untyped-def]
    """The sum of the first directions times weights."""
    for i in range(combined.size):
        combined[i] = 0.0
    for k in range(weights.size):
        for i in range(combined.size):
            combined[i] += weights[k] * directions[k, i]
