"""Many windows of one surface: their places, the scatter of a quantity between them, and its trend with their size."""
