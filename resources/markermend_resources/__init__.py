"""Data that ships with Markermend: demo take, icons, themes. No code."""
