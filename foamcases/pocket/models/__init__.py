"""The models of a pocket that run OpenFOAM, one in each file."""
