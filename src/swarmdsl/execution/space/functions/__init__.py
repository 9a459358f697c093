"""Models of functions in a space, each for many robots at a time."""
