"""OpenFOAM cases of a pocket in a sliding film."""
