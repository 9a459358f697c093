"""Edit existing models from the command line: `swarmc add` and `swarmc rename`.

Text outside the change stays the same, byte for byte. A change is checked first; if it would cause
an error, nothing is written and the error is reported.
"""
