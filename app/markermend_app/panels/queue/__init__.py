"""The queue of artifacts to review."""
