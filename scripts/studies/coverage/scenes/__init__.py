"""Random scenes, a module for each kind, with ``draw(rng)``, which returns the entries of a scene file."""
