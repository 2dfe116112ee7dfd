"""Regeneration of the figures of Paper D of the source, and judgement of its claims."""
