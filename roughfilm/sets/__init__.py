"""Commands over a set of windows: each window on its own, and the mean over them with its scatter."""
