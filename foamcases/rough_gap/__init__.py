"""Cases of a rough gap."""
