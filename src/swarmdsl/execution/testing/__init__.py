"""Behavior tests: TOML files beside a model with steps and expectations."""
