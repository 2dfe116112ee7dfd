"""Charts of speed against accuracy, with solvers of other projects."""
