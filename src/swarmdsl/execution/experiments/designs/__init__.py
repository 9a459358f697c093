"""Designs of experiments: which points of the settings to run."""
