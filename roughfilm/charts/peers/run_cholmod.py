"""CHOLMOD of SuiteSparse; the way is its ordering."""

from sksparse.cholmod import cholesky

NAME, TOLERANCES = "scikit-sparse", (0.0,)


def solver(ordering):
    def solve(case, _tolerance):
        return cholesky(case.matrix, mode="auto", ordering_method=ordering).solve_A(case.sources)

    return solve
