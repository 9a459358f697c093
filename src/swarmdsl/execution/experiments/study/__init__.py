"""Studies: experiments as a file describes them, from factors and levels to answers."""
