"""The error laws behind the advice: fitted to random scenes, checked on others."""
