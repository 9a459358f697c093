"""Results of a verification: diagnostics, text, JSON, JUnit XML, and runs as behaviour tests.

In: verdicts and findings. Out: text and files. Read `diagnostics.py` first.
"""
