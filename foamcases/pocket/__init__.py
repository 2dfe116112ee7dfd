"""Cases of a pocket."""
