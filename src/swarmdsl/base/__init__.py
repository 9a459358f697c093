"""Values and services that know nothing of the language."""
