"""The pipeline, the project file, and incremental checking."""
