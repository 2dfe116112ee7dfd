"""Studies that regenerate the figures of the source and judge its claims."""
