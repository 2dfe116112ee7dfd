"""Dry surfaces in contact, and the ground the other packages stand on: errors and whole files.

This is the lowest package: it has no fluid and no scene, and imports neither ``rom`` nor ``foamcases``.
"""
