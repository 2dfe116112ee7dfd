"""Height, feature and spatial parameters of a surface, and their exact values on simple surfaces."""
