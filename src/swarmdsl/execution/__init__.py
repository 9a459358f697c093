"""The engine, and what runs models on it."""
