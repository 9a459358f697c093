"""From the intermediate representation back to the text of a model.

`lower(parse(print_system(system)))` equals `normalized(system)`; `printer/normal.py` says
what that changes, which is nothing for most systems that come from one file. Constants,
enums, aliases and libraries are not in the representation any more: their values and what
is used of them stand in the text, a topic that is monitored has an event of its own.

A system that no model leads to, built by hand or by an importer, may have no text; then
`UnprintableError` says why: a transition that waits for nothing or for another state's end,
or leads to a state that another one of its name hides; a number that is infinite. A system
in which nothing is declared has no text either: a file that says nothing is no model.
"""
