"""Syntax errors: messages and hints."""
