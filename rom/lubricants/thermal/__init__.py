"""Viscosity, density and heat of lubricants over temperature."""
