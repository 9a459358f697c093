"""Text-first compiler for swarms of robots."""
