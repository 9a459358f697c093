"""Compare two models element by element: `swarmc diff`."""
