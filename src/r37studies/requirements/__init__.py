"""Requirements on blades in operation, and whether each is met: the verdict of a run."""
