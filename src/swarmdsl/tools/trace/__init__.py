"""Output of programs that names generated files, with the places in the model that it is about."""
