"""The commands people run: arguments in, one call, files out; and the pictures they look at."""
