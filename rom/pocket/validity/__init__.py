"""Where the models of a pocket hold: the numbers of a scene, promised errors, and warnings."""
