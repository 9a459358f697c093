"""Searches and experiments: many candidates, many seeds, many workers."""
