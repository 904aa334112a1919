"""Windows over the window: questions, preferences, smoothing, the manual."""
