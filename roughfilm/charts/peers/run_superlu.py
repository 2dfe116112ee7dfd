"""SuperLU, as SciPy has it; the way is its ordering."""

from scipy.sparse.linalg import splu

NAME, TOLERANCES = "scipy", (0.0,)


def solver(ordering):
    symmetric = {"diag_pivot_thresh": 0.0, "options": {"SymmetricMode": True}}
    options = {} if ordering == "COLAMD" else symmetric

    def solve(case, _tolerance):
        return splu(case.matrix, permc_spec=ordering, **options).solve(case.sources)

    return solve
