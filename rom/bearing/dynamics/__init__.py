"""Stiffness and damping of bearings over speed and load, and the whirl of a rigid rotor that they carry."""
