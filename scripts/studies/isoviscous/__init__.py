"""Study of published tables by models with temperature, with a viscosity that does not change."""
