"""Cells in plan: dimples in a periodic rectangle under a sliding wall, with flow in both directions of the film."""
