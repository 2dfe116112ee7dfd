"""Films of a lubricant whose viscosity falls with the shear rate."""
