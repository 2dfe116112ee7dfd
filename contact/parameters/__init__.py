"""Height, feature and spatial parameters of surfaces, and their exact values for simple surfaces."""
