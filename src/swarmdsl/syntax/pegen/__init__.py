"""Parser generator: makes the parser, tables of keywords and editor files from the grammar.

`grammar` reads the textX grammar, `analysis` computes FIRST sets, `emit_functions` writes the
parser, `program` the instructions for `parser.failure_finder`, `keywords` and `editors` the rest;
`outputs` puts it all together for `make parser`.
"""
