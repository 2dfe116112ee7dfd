"""Bearings whose walls move freely as rigid bodies: equilibria, motion in time, stiffness and damping."""
