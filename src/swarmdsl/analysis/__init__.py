"""Name resolution, types and checks."""
