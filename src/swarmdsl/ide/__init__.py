"""Language server, live preview, highlighting."""
