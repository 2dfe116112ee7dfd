"""Estimates of contact area, gap and pressure from statistics of the heights."""
