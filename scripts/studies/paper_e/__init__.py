"""Regeneration of the figures of Paper E of the source, and judgement of its claims."""
