"""The models of a pocket that run OpenFOAM, one a file."""
