"""Search for the best candidate: methods that propose points, and a race between candidates."""
