"""The film under a load: a search for the minimum film thickness at which a bearing carries it."""
