"""The models of a dry contact, one per file."""
