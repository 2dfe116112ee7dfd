"""The commands under 'Surfaces' in the help, one a file."""
