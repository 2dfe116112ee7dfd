"""Programs and studies that are not installed."""
