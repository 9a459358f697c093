"""Pictures of a model that follow its text, in a browser or in a view of an editor."""
