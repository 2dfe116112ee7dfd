"""What the manual takes from the code: keys of scenes, commands, the interface of Python; and its formulas."""
