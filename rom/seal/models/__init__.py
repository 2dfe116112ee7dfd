"""The models of a seal, one per file."""
