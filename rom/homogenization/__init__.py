"""Homogenization of roughness: pressure, shear and friction flow factors of a periodic gap."""
