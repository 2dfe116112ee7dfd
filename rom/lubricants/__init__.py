"""Density and viscosity of lubricants over pressure."""
