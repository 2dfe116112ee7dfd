"""The least film of a bearing, and the numbers of the whole bearing of several pieces."""
