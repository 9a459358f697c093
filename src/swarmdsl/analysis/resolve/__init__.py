"""Resolve names across files."""
