"""One file, one kind of scene; each ends with ``KIND``."""
