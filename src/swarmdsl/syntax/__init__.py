"""Syntax: trees, parser, recovery, errors, formatter."""
