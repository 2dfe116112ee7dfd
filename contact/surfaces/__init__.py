"""A surface as heights on a grid, and the files it is read from and stored in."""
