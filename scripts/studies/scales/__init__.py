"""Study of the wavelengths of roughness for which averaging is accurate."""
