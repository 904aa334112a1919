"""Work off the GUI thread, and what is made ready ahead of the operator."""
