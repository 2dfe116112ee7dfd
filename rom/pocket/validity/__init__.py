"""Where the models of a pocket hold: the numbers of a scene, and warnings."""
