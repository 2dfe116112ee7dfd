"""Two measurements on one grid: registration by cross-correlation, the difference of both (wear), and the sum."""
