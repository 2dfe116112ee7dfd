"""Regeneration of the figures of Paper F of the source, and judgement of its claims."""
