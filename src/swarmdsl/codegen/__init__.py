"""SDK for generators, registry of targets, writers of exchange formats."""
