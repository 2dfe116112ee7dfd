"""Marches of bearings in time: what moves them, the numbers of every step, files, uncertainty."""
