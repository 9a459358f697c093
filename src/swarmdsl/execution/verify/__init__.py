"""Proofs about all runs of a swarm, and runs as counterexamples."""
