"""Names of the commands."""

# A command is a function in the module of its name; `_` follows a keyword of Python.
COMMANDS = (
    "add",
    "build",
    "check",
    "codegen",
    "completion",
    "debug",
    "diagram",
    "diff",
    "doc",
    "doctor",
    "experiment",
    "explain",
    "fleet",
    "fmt",
    "import",
    "lsp",
    "merge",
    "new",
    "optimize",
    "play",
    "preview",
    "rename",
    "results",
    "serve",
    "simulate",
    "targets",
    "test",
    "trace",
    "verify",
)
# Commands with options as plain data: their command lines in plain form are read without Click.
PLAIN = ("build", "check")
