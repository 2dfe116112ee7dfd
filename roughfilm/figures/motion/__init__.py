"""Figures of bearings whose walls move: stiffness, damping and stability, and motions over time."""
