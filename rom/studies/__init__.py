"""Studies of many cases of one scene: sweeps, tables, comparison, grid convergence, and the ordering of errors."""
