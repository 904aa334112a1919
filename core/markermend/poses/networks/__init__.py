"""The residual network of goncalves2024: trained, and run without the library that trained it."""
