"""The models of a rough gap that run OpenFOAM, one in each file."""
