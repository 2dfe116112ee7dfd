"""Tables of a scene file that several kinds of scenes share."""
