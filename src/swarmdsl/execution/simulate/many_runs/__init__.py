"""Many runs with different seeds: `swarmc simulate --runs`.

In: a prepared run. Out: estimates with intervals, decisions on properties with a chance, and
histograms. Read `many.py` first.
"""
