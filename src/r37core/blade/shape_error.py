"""The error raised for a blade shape that cannot exist."""


class BladeShapeError(ValueError):
    """An impossible blade shape; the message names the span at fault and, where known, the blade."""
