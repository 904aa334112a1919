"""The experiments of the papers, and ours beyond them, as rerunnable functions with a table."""
