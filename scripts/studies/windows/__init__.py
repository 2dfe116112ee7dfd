"""Whether seeds of a fitted description scatter as the windows of measured surfaces do."""
