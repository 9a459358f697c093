"""Handlers of requests, grouped by the imports that they need."""
