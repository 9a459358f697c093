"""Diagrams that follow the text of a model, in a browser or in an editor."""
