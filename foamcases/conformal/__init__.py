"""Near-orthogonal meshes of gaps with grooves, from a conformal map."""
