"""Maps of where solvers converge and how accurate they are."""
