"""Temperature of a bearing: what its scene gives, the heat balance, and films coupled with their temperature."""
