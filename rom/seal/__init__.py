"""Leakage between a rough surface and a flat one."""
