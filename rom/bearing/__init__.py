"""Bearings: pads, journals, washers; cavitation, roughness and asperities."""
