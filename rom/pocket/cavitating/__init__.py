"""Films of a pocket that rupture at the cavitation pressure, with conservation of mass."""
