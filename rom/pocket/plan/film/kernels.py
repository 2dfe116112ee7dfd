"""Loops over the cells of a film in plan: velocities and flows at the faces, and the momentum through them.

All arrays at points across the film have the shape (nx, ny, points). Cells are periodic; the node (i, j) has the
momentum cell of u ahead of it along x, that of v ahead along y, and a corner of both ahead along both.
"""

import numpy as np

from roughfilm.contact.foundation.compiled import compiled


@compiled
def face_values(u, v, psi_u, psi_v, excess_u, excess_v, thickness, grid, first, first_sum, upwind, known, central, out):  # type: ignore[no-untyped-def]
    """Interpolate to the faces of all cells; linear in the velocities and stream functions but for the directions.

    Parameters
    ----------
    u, v, psi_u, psi_v : velocities, and stream functions over the film thickness, of the cells.
    excess_u, excess_v : changes of the first amplitudes per change of 1/h that keep the flow, shape (nx, ny).
    thickness : film thickness in the cells of u and v and at the nodes, shape (3, nx, ny).
    grid : lengths of the cells along an axis and between their middles, weights of the upstream cell, 1 or 0 by the
        order, shape (2, 3, n), first along x.
    first, first_sum : the first polynomial and its primitive.
    upwind : directions of u and v at nodes and of v and u at corners, 1 forward or 0, shape (4, nx, ny, points).
    known : whether the directions are given; if not they are determined.
    out : u and v at nodes; u and v at corners; flows v and u through corners; rises of u and v, shape (8, ...).
    """
    nx, ny, points = u.shape
    hu, hv, hp = thickness[0], thickness[1], thickness[2]
    lx, ly, bx, by = grid[0, 0], grid[1, 0], grid[0, 1], grid[1, 1]
    for i in range(nx):
        i1, i2, ip = (i - 1) % nx, (i - 2) % nx, (i + 1) % nx
        for j in range(ny):
            j1, j2, jp = (j - 1) % ny, (j - 2) % ny, (j + 1) % ny
            # u along x at the node
            here = 1 / hp[i, j]
            e2 = (hu[i2, j] * here - 1) * excess_u[i2, j]
            e1 = (hu[i1, j] * here - 1) * excess_u[i1, j]
            e0 = (hu[i, j] * here - 1) * excess_u[i, j]
            ep = (hu[ip, j] * here - 1) * excess_u[ip, j]
            behind, ahead = grid[0, 2, i1], grid[0, 3, i]
            left = lx[i] / (lx[i1] + lx[i])
            for m in range(points):
                middle = left * (u[i1, j, m] + first[m] * e1) + (1 - left) * (u[i, j, m] + first[m] * e0)
                if not known:
                    upwind[0, i, j, m] = 1.0 if middle > 0 else 0.0
                forward = (1 + behind) * (u[i1, j, m] + first[m] * e1) - behind * (u[i2, j, m] + first[m] * e2)
                backward = (1 + ahead) * (u[i, j, m] + first[m] * e0) - ahead * (u[ip, j, m] + first[m] * ep)
                out[0, i, j, m] = central * middle + (1 - central) * (backward + upwind[0, i, j, m] * (forward - backward))
            # v along y at the node
            e2 = (hv[i, j2] * here - 1) * excess_v[i, j2]
            e1 = (hv[i, j1] * here - 1) * excess_v[i, j1]
            e0 = (hv[i, j] * here - 1) * excess_v[i, j]
            ep = (hv[i, jp] * here - 1) * excess_v[i, jp]
            behind, ahead = grid[1, 2, j1], grid[1, 3, j]
            left = ly[j] / (ly[j1] + ly[j])
            for m in range(points):
                middle = left * (v[i, j1, m] + first[m] * e1) + (1 - left) * (v[i, j, m] + first[m] * e0)
                if not known:
                    upwind[1, i, j, m] = 1.0 if middle > 0 else 0.0
                forward = (1 + behind) * (v[i, j1, m] + first[m] * e1) - behind * (v[i, j2, m] + first[m] * e2)
                backward = (1 + ahead) * (v[i, j, m] + first[m] * e0) - ahead * (v[i, jp, m] + first[m] * ep)
                out[1, i, j, m] = central * middle + (1 - central) * (backward + upwind[1, i, j, m] * (forward - backward))
            # flows through the corner, and the velocities along the other axis that they carry
            behind, ahead = grid[1, 4, j], grid[1, 5, jp]
            for m in range(points):
                flow = (hv[i, j] * v[i, j, m] + hv[ip, j] * v[ip, j, m]) / 2
                if not known:
                    upwind[2, i, j, m] = 1.0 if flow > 0 else 0.0
                forward = (1 + behind) * u[i, j, m] - behind * u[i, j1, m]
                backward = (1 + ahead) * u[i, jp, m] - ahead * u[i, (j + 2) % ny, m]
                middle = (u[i, j, m] + u[i, jp, m]) / 2
                out[2, i, j, m] = central * middle + (1 - central) * (backward + upwind[2, i, j, m] * (forward - backward))
                out[4, i, j, m] = flow
            behind, ahead = grid[0, 4, i], grid[0, 5, ip]
            for m in range(points):
                flow = (hu[i, j] * u[i, j, m] + hu[i, jp] * u[i, jp, m]) / 2
                if not known:
                    upwind[3, i, j, m] = 1.0 if flow > 0 else 0.0
                forward = (1 + behind) * v[i, j, m] - behind * v[i1, j, m]
                backward = (1 + ahead) * v[ip, j, m] - ahead * v[(i + 2) % nx, j, m]
                middle = (v[i, j, m] + v[ip, j, m]) / 2
                out[3, i, j, m] = central * middle + (1 - central) * (backward + upwind[3, i, j, m] * (forward - backward))
                out[5, i, j, m] = flow
    for i in range(nx):
        i1, ip = (i - 1) % nx, (i + 1) % nx
        for j in range(ny):
            j1, jp = (j - 1) % ny, (j + 1) % ny
            a, b, c = lx[i] / (lx[i1] + lx[i]), lx[ip] / (lx[i] + lx[ip]), by[j]
            ea = a * (hu[i1, j] - hp[i, j]) * excess_u[i1, j] + (1 - a) * (hu[i, j] - hp[i, j]) * excess_u[i, j]
            eb = b * (hu[i, j] - hp[ip, j]) * excess_u[i, j] + (1 - b) * (hu[ip, j] - hp[ip, j]) * excess_u[ip, j]
            for m in range(points):
                ahead = hp[ip, j] * (b * psi_u[i, j, m] + (1 - b) * psi_u[ip, j, m]) + first_sum[m] * eb
                behind = hp[i, j] * (a * psi_u[i1, j, m] + (1 - a) * psi_u[i, j, m]) + first_sum[m] * ea
                side = hv[i, j] * psi_v[i, j, m] + hv[ip, j] * psi_v[ip, j, m]
                side -= hv[i, j1] * psi_v[i, j1, m] + hv[ip, j1] * psi_v[ip, j1, m]
                out[6, i, j, m] = c * (ahead - behind) + lx[i] / 2 * side
            a, b, c = ly[j] / (ly[j1] + ly[j]), ly[jp] / (ly[j] + ly[jp]), bx[i]
            ea = a * (hv[i, j1] - hp[i, j]) * excess_v[i, j1] + (1 - a) * (hv[i, j] - hp[i, j]) * excess_v[i, j]
            eb = b * (hv[i, j] - hp[i, jp]) * excess_v[i, j] + (1 - b) * (hv[i, jp] - hp[i, jp]) * excess_v[i, jp]
            for m in range(points):
                ahead = hp[i, jp] * (b * psi_v[i, j, m] + (1 - b) * psi_v[i, jp, m]) + first_sum[m] * eb
                behind = hp[i, j] * (a * psi_v[i, j1, m] + (1 - a) * psi_v[i, j, m]) + first_sum[m] * ea
                side = hu[i, j] * psi_u[i, j, m] + hu[i, jp] * psi_u[i, jp, m]
                side -= hu[i1, j] * psi_u[i1, j, m] + hu[i1, jp] * psi_u[i1, jp, m]
                out[7, i, j, m] = c * (ahead - behind) + ly[j] / 2 * side


@compiled
def momentum(u, v, face, du, dv, dface, thickness, grid, out):  # type: ignore[no-untyped-def]
    """The momentum that leaves each cell, to first order in the changes d of a flow; of the flow itself if both are one.

    ``out`` has the shape (2, 2, nx, ny, points): first the momentum through the sides and then the velocity times the
    flow through the surfaces of constant Y, of u and of v.
    """
    nx, ny, points = u.shape
    hp = thickness[2]
    lx, ly, bx, by = grid[0, 0], grid[1, 0], grid[0, 1], grid[1, 1]
    for i in range(nx):
        i1, ip = (i - 1) % nx, (i + 1) % nx
        for j in range(ny):
            j1, jp = (j - 1) % ny, (j + 1) % ny
            for m in range(points):
                through = hp[ip, j] * face[0, ip, j, m] * dface[0, ip, j, m]
                through -= hp[i, j] * face[0, i, j, m] * dface[0, i, j, m]
                side = face[2, i, j, m] * dface[4, i, j, m] + dface[2, i, j, m] * face[4, i, j, m]
                side -= face[2, i, j1, m] * dface[4, i, j1, m] + dface[2, i, j1, m] * face[4, i, j1, m]
                out[0, 0, i, j, m] = 2 * by[j] * through + lx[i] * side
                out[0, 1, i, j, m] = u[i, j, m] * dface[6, i, j, m] + du[i, j, m] * face[6, i, j, m]
                through = hp[i, jp] * face[1, i, jp, m] * dface[1, i, jp, m]
                through -= hp[i, j] * face[1, i, j, m] * dface[1, i, j, m]
                side = face[3, i, j, m] * dface[5, i, j, m] + dface[3, i, j, m] * face[5, i, j, m]
                side -= face[3, i1, j, m] * dface[5, i1, j, m] + dface[3, i1, j, m] * face[5, i1, j, m]
                out[1, 0, i, j, m] = 2 * bx[i] * through + ly[j] * side
                out[1, 1, i, j, m] = v[i, j, m] * dface[7, i, j, m] + dv[i, j, m] * face[7, i, j, m]
