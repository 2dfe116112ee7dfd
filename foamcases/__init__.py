"""OpenFOAM: gap to mesh to case directory, one checked run, fields read back, and the models that use it."""
