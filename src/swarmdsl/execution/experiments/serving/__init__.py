"""Answer candidates of an optimizer of others: a message in, a message with the fitness out."""
