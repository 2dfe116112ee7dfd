"""SuperLU, as SciPy has it; the way is its ordering."""

from scipy.sparse.linalg import splu

NAME, RULE, TOLERANCES = "scipy", "linear", (0.0,)


def solver(ordering):
    symmetric = {"diag_pivot_thresh": 0.0, "options": {"SymmetricMode": True}}

    def solve(case, _gap, _tolerance):
        return splu(case.matrix, permc_spec=ordering, **(symmetric if ordering != "COLAMD" else {})).solve(case.sources[case.free])

    return solve
