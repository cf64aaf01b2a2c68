"""The spine and its wings together: configuration, targets, captions and remarks of all capabilities."""
