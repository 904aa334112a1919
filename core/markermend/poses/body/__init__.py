"""How a body is built and bends, and noisy or filled joints made to agree with it."""
