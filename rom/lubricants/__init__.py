"""How density and viscosity of a lubricant grow with pressure."""
