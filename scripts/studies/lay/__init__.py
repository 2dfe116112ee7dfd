"""Flow along and across a lay."""
