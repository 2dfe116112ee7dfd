"""What changes in time: tables of speed, load and path, and the body that moves."""
