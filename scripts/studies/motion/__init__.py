"""Whether the uncertainties of films whose walls move hold: equilibria, stiffness and damping, and marches."""
