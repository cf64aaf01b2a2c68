"""The pipeline and its extensions together: configuration, targets, captions, remarks and last lines of all capabilities."""
