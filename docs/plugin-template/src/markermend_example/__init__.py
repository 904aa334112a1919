"""One example of everything that can be added to Markermend."""
