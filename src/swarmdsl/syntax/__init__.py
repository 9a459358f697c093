"""Front end: syntax tree, parser, error recovery, formatter."""
