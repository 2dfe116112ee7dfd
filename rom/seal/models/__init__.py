"""The models of a seal, one a file."""
