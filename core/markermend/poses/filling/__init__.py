"""Fill joints that were not seen, from the rest of the body, from time and from other moments."""
