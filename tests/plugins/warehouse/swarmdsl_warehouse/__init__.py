"""Models of a warehouse, for `import warehouse.*`."""

raise RuntimeError("the module of a library is never run")
