"""Films whose viscosity follows the temperature of each place: the coupling of film and temperature."""
