"""Behaviour tests: text beside a model that says what must happen when it runs."""
