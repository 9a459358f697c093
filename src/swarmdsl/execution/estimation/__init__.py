"""Estimates from many runs: intervals, sequential tests, quantiles, histograms."""
