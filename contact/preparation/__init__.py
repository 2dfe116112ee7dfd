"""From a measured surface to a periodic roughness cell: one pure step a file, and the recipe that names them."""
