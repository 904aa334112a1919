"""All markers over all time, as a picture of damage."""
