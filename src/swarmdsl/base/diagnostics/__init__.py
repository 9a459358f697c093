"""Diagnostics: catalogue, collector, explanations, renderers."""
