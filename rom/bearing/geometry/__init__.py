"""The shapes of the films of bearings."""
