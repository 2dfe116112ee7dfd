"""Regeneration of the figures of Paper B of the source, and judgement of its claims."""
