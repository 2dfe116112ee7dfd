"""Temperature of a film: energy equations over it and across it, walls, and exact solutions."""
