"""The desktop application: it shows a session and holds no science."""
