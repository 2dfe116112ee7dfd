"""Numbers of a converged film that all kinds of scenes share: flows, friction, peaks, errors by the grid."""
