"""Kept runs of experiments and searches: lists, filters, comparisons, exports."""
