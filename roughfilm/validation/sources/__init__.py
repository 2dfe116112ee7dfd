"""One module for each published source; each ends with ``SOURCE = Source(...)``."""
