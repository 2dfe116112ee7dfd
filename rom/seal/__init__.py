"""Models of leakage between a rough surface and a flat one."""
