; Lines within brackets are indented, for Helix and Zed.
(_ "{" "}" @end @outdent) @indent
(_ "(" ")" @end @outdent) @indent
