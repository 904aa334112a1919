"""Predictors: where a marker should be, from the rest of its body."""
