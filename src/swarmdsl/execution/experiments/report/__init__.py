"""Reports of experiments and searches: one HTML page that needs no network and runs no script."""
