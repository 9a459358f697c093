"""Print the intermediate representation as the text of a model.

`lower(parse(print_system(system)))` equals `normalized(system)`; `swarm_printer/normal.py`
says what that changes, which is nothing for most systems that come from one file. Constants,
enums, aliases and libraries are not in the representation any more: the text has their values
and the used declarations, and a monitored topic has an event of its own.

A system that no model leads to, built by hand or by an importer, may have no text; then
`UnprintableError` gives the reason: a transition that waits for nothing or for another state's
end, or leads to a state that is hidden by another one of its name; a number that is infinite.
A system without declarations has no text either: an empty file is no model.
"""
