"""The models of a pocket, one a file."""
