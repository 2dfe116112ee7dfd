"""OpenFOAM cases of a gap between rough walls."""
