"""One file, one model; each ends with ``MODEL``."""
