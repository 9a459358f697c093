"""Parser: tokens, expressions, documentation comments, syntax trees."""
