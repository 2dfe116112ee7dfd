"""Step 8 of the preparation: join opposite edges of the window, so that the cell is periodic."""
