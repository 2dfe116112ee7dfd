"""The models of a dry contact, one a file."""
