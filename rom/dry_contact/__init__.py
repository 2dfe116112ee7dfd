"""A rough surface pressed on a flat one without a liquid."""
