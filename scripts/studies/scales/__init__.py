"""Down to which wavelength roughness may be averaged."""
