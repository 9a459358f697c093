; Names of captures are those that Neovim, Helix and Zed share.
; Of two captures of a node the later one counts, so the special ones come last; leaves are captured,
; since some editors prefer the inner one of two nodes.
(identifier) @variable
(comment) @comment
(string) @string
[(quantity) (integer) (negative) (decimal) (length)] @number
(type_name (identifier) @type)

; made by `make parser`
["abstraction" "action" "actuator" "again" "all" "always" "append" "area" "at" "battery" "before"
    "behavior" "between" "body" "call" "cancel" "cancels" "choice" "clear" "communication"
    "connect" "const" "contract" "controller" "covered" "dead" "deep" "defer" "distance" "each"
    "endless" "ends" "energy" "entry" "enum" "environment" "event" "eventually" "exit" "extends"
    "feedback" "final" "fitness" "found" "from" "function" "goal" "has" "hears" "heartbeat"
    "height" "history" "initial" "inout" "leads" "least" "lost" "max" "mean" "member" "message"
    "min" "model" "most" "neighbors" "never" "no" "obstacle" "only" "operation" "operator"
    "optimize" "other" "out" "parallel" "param" "possible" "property" "radio" "radius" "rain"
    "random" "reach" "region" "remove" "request" "response" "result" "self" "sends" "senses"
    "sensor" "service" "some" "starts" "state" "statemachine" "struct" "sum" "swarm" "target"
    "then" "time" "times" "total" "type" "until" "var" "virtual" "wall" "when" "where" "wind"
    "within" "zone"] @keyword
["import" "package" "ros"] @keyword.import
["after" "as" "best" "by" "count" "deadline" "do" "done" "effort" "else" "evaluations" "gives"
    "in" "internal" "keep" "latest" "lifespan" "maximize" "minimize" "monitor" "of" "on"
    "reliable" "seed" "send" "size" "step" "steps" "subject" "to" "world" "x"] @keyword
["aborted" "preempted" "succeeded"] @constant.builtin
["and" "not" "or"] @keyword
["false" "true"] @boolean
((identifier) @type.builtin
  (#any-of? @type.builtin "bool" "byte" "char" "int8" "uint8" "int16" "uint16" "int32" "uint32"
    "int64" "uint64" "float32" "float64" "string" "wstring" "time" "duration"))
; end

["->" ".." "=>" "=" "==" "!=" "<" "<=" ">" ">=" "+" "-" "*" "/" "%"] @operator
["(" ")" "[" "]" "{" "}"] @punctuation.bracket
["," ":" ";" "."] @punctuation.delimiter
(later) @keyword
(interface (identifier) @type)
(call . (identifier) @function)
(query . (identifier) @function)
(construction . (identifier) @type)
(path ["event" "self"] @variable.builtin)
(field_name (identifier) @property)
(port_name (identifier) @property)

(state_machine name: (name (identifier) @type))
(component name: (name (identifier) @type))
(member name: (name (identifier) @type))
(swarm name: (name (identifier) @type))
(environment name: (name (identifier) @type))
(struct_type name: (name (identifier) @type))
(enum_type name: (name (identifier) @type))
(alias_type name: (name (identifier) @type))
(event name: (name (identifier) @constant))
(constant name: (name (identifier) @constant))
(function name: (name (identifier) @function))
(operation name: (name (identifier) @function))
(activity function: (qualified_name (identifier) @function))
(event_trigger event: (qualified_name (identifier) @constant))
(send event: (qualified_name (identifier) @constant))
[
  (state name: (name (identifier) @label))
  (parallel name: (name (identifier) @label))
  (choice name: (name (identifier) @label))
  (final_state name: (name (identifier) @label))
  (initial target: (qualified_name (identifier) @label))
  (transition target: (qualified_name (identifier) @label))
  (branch target: (qualified_name (identifier) @label))
]
