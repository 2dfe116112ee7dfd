"""Independent or finer solutions, a module for each kind, with ``truth(scene)``, which returns a ``Truth``."""
