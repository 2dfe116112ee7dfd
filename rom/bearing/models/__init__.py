"""The models of a bearing, one a file."""
