"""Files of a model and what they import."""
