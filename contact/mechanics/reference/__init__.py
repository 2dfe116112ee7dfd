"""The contact algorithm of the thesis, kept for comparison with `roughfilm.contact.mechanics.press`."""
