"""Mixed lubrication: asperities and liquid carry one load between them."""
