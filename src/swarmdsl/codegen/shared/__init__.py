"""Views of the IR that several targets share."""
