"""Contact area, gap and pressure estimated from statistics of the heights."""
