"""Flow between rough walls to second order in slope, and exact solutions."""
