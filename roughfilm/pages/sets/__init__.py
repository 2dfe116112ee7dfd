"""Pages of a set of windows."""
