"""Recovery from syntax errors."""
