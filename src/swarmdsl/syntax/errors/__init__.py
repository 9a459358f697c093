"""Syntax errors and their hints."""
