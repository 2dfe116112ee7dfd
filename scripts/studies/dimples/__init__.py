"""Films over dimples: textures in three dimensions."""
