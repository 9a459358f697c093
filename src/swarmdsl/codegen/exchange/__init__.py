"""Exchange formats of CPSwarm, FREVO and SCXML, written from the IR."""
