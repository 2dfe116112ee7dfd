"""OpenFOAM cases: mesh a gap, write the case directory, run and check it, read its fields; models that do so."""
