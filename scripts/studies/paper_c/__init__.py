"""Regeneration of the figures of Paper C of the source, and judgement of its claims."""
