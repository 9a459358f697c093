"""Error recovery of the parser."""
