"""The functions of the public interface, by subject; ``roughfilm`` loads each when it is first used."""
