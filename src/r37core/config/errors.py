"""The one error of a configuration that cannot be used."""


class ConfigError(ValueError):
    """The message names the file, the line where there is one, the key, what was found and what is allowed."""
