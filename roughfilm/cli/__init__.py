"""The commands, one a file, in folders by their use."""
