"""OpenFOAM cases of infinitely wide pads between two end sections."""
