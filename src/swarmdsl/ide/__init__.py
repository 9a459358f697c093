"""Language server, debug adapter, live preview, page of running robots, highlighting."""
