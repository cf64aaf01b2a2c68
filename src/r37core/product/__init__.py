"""The pipeline and its extensions together: configuration, targets, captions and remarks of all capabilities."""
