"""OpenFOAM cases of one periodic cell of a film over dimples."""
