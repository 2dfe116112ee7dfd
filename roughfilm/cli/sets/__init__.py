"""The commands of which a set of windows takes the place of the surface."""
