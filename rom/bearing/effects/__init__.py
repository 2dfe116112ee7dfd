"""How much each physical effect contributes to a bearing."""
