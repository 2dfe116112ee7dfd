"""One file, one kind of scene as its pages show it; each ends with ``VIEW``."""
