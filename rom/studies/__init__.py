"""Many cases of one scene: sweeps, tables, comparison, convergence, and what orders errors."""
