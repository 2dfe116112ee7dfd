"""The models of a bearing that run OpenFOAM, one in each file."""
