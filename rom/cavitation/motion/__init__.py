"""Films whose walls move as rigid bodies: equilibria, motion in time, stiffness and damping."""
