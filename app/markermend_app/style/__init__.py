"""How the app looks: colours, icons, style sheet."""
