"""Infinitely wide pads whose flow is resolved across the film: with inertia, and with slope."""
