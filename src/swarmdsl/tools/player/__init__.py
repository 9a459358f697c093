"""Player: a run as one page that shows every moment of it, without a network."""
