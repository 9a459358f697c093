"""Text-first compiler for swarms of robots."""

__version__ = "0.2.0"
