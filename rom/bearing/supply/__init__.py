"""Oil supply inside the film: grooves, holes and pockets, at a pressure or behind restrictors."""
