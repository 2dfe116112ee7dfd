"""A step of Newton's method in the plane."""

import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as sl


def plane_step(network, linear, accuracy):
    nx, ny = network.shape
    n = nx * ny
    idx = np.arange(n).reshape(nx, ny)
    rows = np.concatenate([idx.ravel()] * 5)
    cols = np.concatenate(
        [
            idx.ravel(),
            np.roll(idx, 1, 0).ravel(),
            np.roll(idx, -1, 0).ravel(),
            np.roll(idx, 1, 1).ravel(),
            np.roll(idx, -1, 1).ravel(),
        ]
    )
    vals = np.concatenate([a.ravel() for a in (linear.centre, linear.west, linear.east, linear.south, linear.north)])
    A = sp.csc_matrix((vals, (rows, cols)), shape=(n, n))
    return sl.spsolve(A, -linear.balance.ravel()).reshape(nx, ny)
