"""Geometry of environments that several targets write."""
