"""Thin liquid films by a ladder of models, from Reynolds to Navier-Stokes in OpenFOAM."""
