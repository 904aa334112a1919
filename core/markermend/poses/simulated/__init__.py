"""Sensors simulated: their noise, their proportions and their worst faults."""
