"""The contributions of physical effects to the load, friction and flow of a bearing."""
