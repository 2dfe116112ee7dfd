"""The functions of the public interface by subject; the package ``roughfilm`` imports each one at its first use."""
