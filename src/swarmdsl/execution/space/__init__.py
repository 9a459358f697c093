"""Flat space of a simulated world: places, motion, energy, radio and sight in arrays of NumPy."""
