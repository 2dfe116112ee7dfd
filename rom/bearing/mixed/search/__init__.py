"""Searches for the film under a load at each speed of a curve, isothermal and heated."""
