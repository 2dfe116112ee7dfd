"""Pardiso of oneMKL, for matrices that are symmetric and positive definite, of which it takes the upper triangle."""

import numpy as np
from pypardiso import PyPardisoSolver
from scipy.sparse import triu

NAME, TOLERANCES = "pypardiso", (0.0,)


def solver(_way):
    def solve(case, _tolerance):
        pardiso = PyPardisoSolver(mtype=2)
        upper = triu(case.matrix, format="csr")
        try:
            pardiso.factorize(upper)
            return np.asarray(pardiso.solve(upper, np.asfortranarray(case.sources)))
        finally:
            pardiso.free_memory(everything=True)

    return solve
