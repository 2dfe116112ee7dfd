"""How each kind of scene is shown, one a file."""
