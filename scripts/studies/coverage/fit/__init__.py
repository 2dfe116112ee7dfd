"""Fit of the error laws of the models to the scenes of this study."""
