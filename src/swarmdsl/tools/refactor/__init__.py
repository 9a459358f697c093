"""Changes of models that exist, from the command line: `swarmc add` and `swarmc rename`.

All that is not changed stays as it is, byte for byte. A change is tried before it is made: one that
would make a mistake is not made, and the mistake is told.
"""
