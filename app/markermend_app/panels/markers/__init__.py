"""The tree of markers in the order of the body."""
