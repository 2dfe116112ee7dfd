"""The models of a pocket, one per file."""
