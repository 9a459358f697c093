"""The exchange formats of the field, written from the IR."""
