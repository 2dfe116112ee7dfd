"""The commands under 'Many cases' in the help, one a file."""
