"""Seals: what two rough bodies pressed on each other let through between them, and where they let nothing through."""
