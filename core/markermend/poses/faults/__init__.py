"""Joints that a sensor reports wrongly without saying so: which, and what is wrong with them."""
