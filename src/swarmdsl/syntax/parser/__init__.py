"""Lexer, expression parser and generated parser."""
