"""Two ways a parallel textured film carries load: inertia and cavitation."""
