"""The commands under 'First steps' in the help, one a file."""
