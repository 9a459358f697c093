"""Catalogue of all diagnostics.

Each code has a page in `explain/` (printed by `swarmc explain CODE`) and a case in
`tests/diagnostics/`. The number of a removed code is never reused.

    00xx  files and imports      04xx  components, ports, connectors
    01xx  syntax                 05xx  state machines
    02xx  names                  06xx  functions and interfaces
    03xx  swarm composition      07xx  expressions
    08xx  SCXML documents        09xx  generators and output
    10xx  simulation             11xx  tests
    12xx  import                 13xx  diagrams
    14xx  comparison             15xx  new projects, changes of models
    16xx  properties                 17xx  verification
    18xx  experiments
"""

# The annotations here are values: typing would compile texts one by one.
from typing import NamedTuple


class Code(NamedTuple):
    """One kind of diagnostic; `message` is filled in with `str.format`.

    A `silent` warning is reported only if it is enabled by name.
    """

    code: str
    severity: str
    message: str
    silent: bool = False


CODES: dict[str, Code] = {
    # ---- files and imports
    "file-not-found": Code("SW0001", "error", "no such file: `{path}`"),
    "not-a-file": Code("SW0002", "error", "`{path}` is {actual}, not {expected}"),
    "unreadable-file": Code("SW0003", "error", "cannot read `{path}`: {reason}"),
    "not-text": Code("SW0004", "error", "`{path}` is not UTF-8 text"),
    "empty-file": Code("SW0005", "error", "this file declares nothing"),
    "import-cycle": Code("SW0006", "error", "`{path}` imports itself"),
    "nothing-to-compile": Code("SW0007", "error", "no .swarm file in `{path}`"),
    "unknown-package": Code("SW0008", "error", "no package called `{name}`"),
    "control-character": Code("SW0009", "error", "control character {code} is not allowed"),
    "broken-library": Code("SW0010", "warning", "cannot load library `{name}`: {reason}"),
    "bad-toml": Code("SW0011", "error", "`{path}` is not valid TOML: {reason}"),
    "unknown-key": Code("SW0012", "error", "{owner} has no key `{name}`"),
    "wrong-value": Code("SW0013", "error", "`{name}` takes {expected}, not {found}"),
    "unknown-diagnostic": Code("SW0014", "error", "there is no diagnostic `{name}`"),
    "not-a-warning": Code("SW0015", "error", "`{name}` is an error and cannot be downgraded"),
    "outside-workspace": Code("SW0016", "error", "`{path}` is outside the workspace"),
    "outside-project": Code("SW0017", "error", "`{path}` is outside the project"),
    "too-many-files": Code("SW0018", "error", "cannot search `{path}`: {reason}"),
    # ---- syntax
    "syntax-error": Code("SW0101", "error", "{message}"),
    "unclosed-bracket": Code("SW0102", "error", "this `{bracket}` is never closed"),
    "keyword-as-name": Code("SW0103", "error", "`{word}` is a keyword and cannot be a name"),
    "nested-too-deeply": Code("SW0104", "error", "nested deeper than {limit} levels"),
    "unattached-doc-comment": Code("SW0105", "warning", "this `///` comment documents nothing"),
    "unterminated-text": Code("SW0106", "error", 'this string has no closing `"`'),
    "unterminated-comment": Code("SW0107", "error", "this comment has no closing `*/`"),
    "missing-separator": Code(
        "SW0108", "error", "no line break or `{separator}` before the next {what}"
    ),
    # ---- names
    "duplicate-name": Code("SW0201", "error", "{kind} `{name}` is declared twice"),
    "unresolved-name": Code("SW0202", "error", "no {kind} called `{name}`"),
    "ambiguous-name": Code("SW0203", "error", "`{name}` is ambiguous"),
    "wrong-kind": Code("SW0204", "error", "`{name}` is {actual}, not {expected}"),
    "reserved-event-name": Code("SW0205", "error", "event name `{name}` is reserved"),
    "naming-style": Code("SW0206", "warning", "{kind} `{name}` is not in {style}"),
    "unused-declaration": Code("SW0207", "warning", "{kind} `{name}` is never used", silent=True),
    # ---- swarm composition
    "empty-multiplicity": Code("SW0301", "error", "multiplicity `{multiplicity}` {fault}"),
    "empty-swarm": Code("SW0302", "error", "swarm `{name}` has no members"),
    "impossible-size": Code("SW0303", "error", "size `{size}` {fault}"),
    "missing-objective": Code("SW0304", "error", "fitness `{name}` has no objective"),
    "empty-range": Code("SW0305", "error", "this range {fault}"),
    "impossible-setting": Code("SW0306", "error", "`{name}` must be at least {least}"),
    "default-outside": Code("SW0307", "warning", "the default of `{name}` is outside this range"),
    "empty-optimization": Code(
        "SW0308", "warning", "the optimization of swarm `{name}` varies nothing"
    ),
    "missing-fitness": Code("SW0309", "error", "swarm `{name}` is optimized but has no fitness"),
    "missing-robot-value": Code("SW0310", "error", "param `{name}` of {robots} has no value"),
    "unknown-robot": Code("SW0311", "error", "role `{role}` has no robot `{robot}`"),
    "impossible-shape": Code("SW0312", "error", "{what} {fault}"),
    "outside-environment": Code("SW0313", "error", "{what} is outside the environment"),
    "blocked-start": Code("SW0314", "error", "{robots} cannot start here: {reason}"),
    "missing-setting": Code("SW0315", "error", "{owner} has no `{name}`"),
    "setting-range": Code("SW0316", "error", "`{name}` must be {expected}"),
    "missing-speed": Code(
        "SW0317", "error", "member `{member}` has no speed, but model `{model}` moves it"
    ),
    "early-loss": Code("SW0320", "error", "a robot would be lost before its next heartbeat"),
    "unfit-constraint": Code("SW0321", "error", "property `{name}` {fault}"),
    # ---- components, ports, connectors
    "port-direction": Code("SW0401", "error", "{fault}"),
    "port-type-mismatch": Code(
        "SW0402", "error", "`{source}` sends {sent}, but `{target}` takes {taken}"
    ),
    "unknown-param": Code("SW0403", "error", "{owner} has no param `{name}`"),
    "repeated-item": Code("SW0404", "error", "{item} is given twice"),
    "inheritance-cycle": Code("SW0405", "error", "`{name}` extends itself"),
    "unknown-setting": Code("SW0406", "error", "there is no setting `{name}`"),
    "unconnected-port": Code("SW0407", "warning", "port `{port}` is not connected"),
    "driven-twice": Code("SW0408", "warning", "`{port}` receives data from two connectors"),
    "shared-topic": Code("SW0409", "warning", "two connections share topic `{topic}`"),
    "replaced-topic": Code(
        "SW0410", "warning", "topic `{own}` of `{port}` is replaced by `{topic}`"
    ),
    # ---- state machines
    "missing-initial": Code("SW0501", "error", "{owner} has no initial state"),
    "missing-final": Code("SW0502", "error", "{owner} has no final state"),
    "unreachable-state": Code("SW0503", "warning", "{kind} `{name}` is unreachable"),
    "transition-never-fires": Code("SW0504", "warning", "this transition can never fire"),
    "unhandled-outcome": Code("SW0505", "error", "unhandled {outcomes} of `{function}`"),
    "submachine-cycle": Code("SW0506", "error", "state machine `{name}` contains itself"),
    "outcome-without-activity": Code(
        "SW0507", "error", "state `{state}` has no activity with outcome `{outcome}`"
    ),
    "done-without-content": Code("SW0508", "error", "{owner} can never raise `done`"),
    "target-outside": Code("SW0509", "error", "transition cannot lead to `{target}`: {reason}"),
    "choice-without-else": Code("SW0510", "error", "choice `{name}` has no `else`"),
    "mixed-content": Code("SW0511", "error", "state `{state}` has {content}"),
    "missing-value": Code("SW0512", "error", "param `{name}` of `{machine}` has no value"),
    "too-few-regions": Code("SW0513", "error", "parallel state `{name}` has no regions"),
    "too-many-states": Code(
        "SW0514", "error", "state machine `{name}` has more than {limit} states"
    ),
    "endless-steps": Code(
        "SW0515", "error", "`{name}` is in a cycle of transitions that never waits"
    ),
    "misplaced-internal": Code(
        "SW0516", "error", "internal transition of `{state}` cannot target `{target}`"
    ),
    "misplaced-history": Code("SW0517", "error", "history `{name}` {fault}"),
    "negative-delay": Code("SW0518", "error", "a delay cannot be negative"),
    "constant-guard": Code("SW0519", "warning", "this guard {held} holds"),
    "idle-variable": Code("SW0520", "warning", "variable `{name}` {fault}"),
    "unhandled-event": Code("SW0521", "warning", "event `{name}` is never handled{where}"),
    "conflicting-regions": Code(
        "SW0522", "warning", "two regions leave `{state}` on {event} for different targets"
    ),
    "unsent-event": Code("SW0523", "warning", "event `{name}` is never sent{where}", silent=True),
    "choice-circle": Code("SW0524", "warning", "choice `{name}` is in a cycle of choices"),
    "early-read": Code("SW0525", "warning", "variable `{name}` may be read before it is written"),
    "zero-delay": Code("SW0526", "warning", "a delay of 0 does not wait"),
    "repeated-trigger": Code("SW0527", "warning", "redundant trigger `{trigger}`"),
    "conflicting-effects": Code(
        "SW0528", "warning", "two regions assign to `{variable}` on {event}"
    ),
    "endless-retry": Code(
        "SW0529",
        "warning",
        "`{state}` calls `{function}` again and again while it is aborted",
        silent=True,
    ),
    "ignored-event": Code(
        "SW0530", "warning", "event `{name}` is ignored in {states}{where}", silent=True
    ),
    "needless-defer": Code("SW0531", "warning", "event `{name}` is never deferred by `{state}`"),
    "nothing-to-cancel": Code("SW0532", "warning", "no delayed sending of `{name}` to cancel"),
    "no-heartbeat": Code("SW0541", "error", "`{name}` needs a heartbeat, which {swarms} lacks"),
    "misplaced-membership": Code("SW0542", "error", "`{name}` {fault}"),
    "unnoticed-time": Code("SW0543", "warning", "time alone does not take this transition"),
    "unknown-identity": Code(
        "SW0544", "warning", "no robot of swarm {swarms} has the {what} `{name}`"
    ),
    "hidden-heartbeat": Code(
        "SW0545", "warning", "event `{name}` hides that of the heartbeat of swarm `{swarm}`"
    ),
    "undelayed-send": Code(
        "SW0546", "warning", "this begins a transition: it does not delay `send {event}`"
    ),
    # ---- functions and interfaces
    "unknown-field": Code("SW0601", "error", "{owner} has no field `{name}`"),
    "missing-field": Code("SW0602", "error", "missing value for {fields} in {owner}"),
    "unbound-function": Code(
        "SW0603", "error", "function `{name}` has neither an action nor a service"
    ),
    "interface-kind": Code("SW0604", "error", "`{name}` is {actual}, not {expected}"),
    "type-cycle": Code("SW0605", "error", "type `{name}` is defined in terms of itself"),
    "nested-array": Code("SW0606", "error", "ROS has no arrays of arrays"),
    "shared-callback": Code("SW0607", "error", "callback `{name}` is used by two functions"),
    "impossible-array": Code("SW0608", "error", "{what} cannot have {size}"),
    "enum-value": Code("SW0609", "error", "value `{name}` of enum `{enum}` {fault}"),
    "unknown-interface": Code("SW0610", "warning", "no interface called `{name}`"),
    "bad-topic": Code("SW0611", "error", "`{name}` is not a valid ROS name for {what}"),
    "topic-types": Code("SW0612", "error", "topic `{topic}` carries `{first}`, not `{second}`"),
    "empty-enum": Code("SW0613", "error", "enum `{name}` has no values"),
    "no-first-value": Code(
        "SW0614", "warning", "variable `{name}` starts as 0, which is not a value of enum `{enum}`"
    ),
    "other-than-standard": Code("SW0615", "warning", "`{name}` differs from its definition in ROS"),
    "undescribed-interface": Code(
        "SW0616", "warning", "no definition of interface `{name}`", silent=True
    ),
    "monitor-name": Code("SW0617", "error", "topic `{topic}` cannot be called `{name}`"),
    "local-delivery": Code("SW0618", "error", "event `{name}` stays on one robot: {fault}"),
    "contradictory-delivery": Code("SW0619", "error", "{fault}"),
    "lossy-event": Code(
        "SW0620",
        "warning",
        "best effort event `{name}` may never end `{state}`, which has activities",
        silent=True,
    ),
    "wrong-unit": Code("SW0621", "error", "expected {expected}, found {found}"),
    "unknown-model": Code("SW0622", "error", "there is no model `{name}` for functions"),
    "unknown-argument": Code("SW0623", "error", "model `{model}` has no argument `{name}`"),
    # ---- expressions
    "type-mismatch": Code("SW0701", "error", "expected {expected}, found {found}"),
    "bad-operand": Code("SW0702", "error", "`{operator}` does not work on {operands}"),
    "not-assignable": Code("SW0703", "error", "cannot assign to `{text}`"),
    "not-constant": Code("SW0704", "error", "expected a constant expression"),
    "no-event-data": Code("SW0705", "error", "`event` has no data here"),
    "constant-cycle": Code("SW0706", "error", "constant `{name}` is defined in terms of itself"),
    "no-result": Code("SW0707", "error", "`{operator}` has no result: {fault}"),
    "no-self": Code("SW0708", "error", "`self` has no value here"),
    "no-sender": Code("SW0709", "error", "only a swarm event that is heard has `{name}`"),
    "hidden-sender": Code(
        "SW0710", "warning", "`event.{name}` is a field of `{type}`, not of the event"
    ),
    "local-address": Code("SW0711", "error", "only a swarm event can have an address"),
    "unclear-address": Code(
        "SW0712", "error", "`{name}` is a value, and a role of swarm `{swarm}`"
    ),
    "no-active-state": Code("SW0713", "error", "no state is active here"),
    "state-not-around": Code("SW0714", "error", "state `{name}` is not around this expression"),
    "no-such-item": Code("SW0721", "error", "array `{array}` has no item {number}"),
    "unbounded-array": Code("SW0722", "error", "array `{name}` grows without a bound"),
    "hidden-value": Code("SW0723", "error", "item `{name}` hides {hidden}"),
    # ---- SCXML documents
    "not-xml": Code("SW0801", "error", "invalid XML: {reason}"),
    "xml-document-type": Code("SW0802", "error", "document type declarations are not supported"),
    "not-scxml": Code("SW0803", "error", "not an SCXML document: the root element is `{name}`"),
    "unknown-element": Code("SW0804", "error", "element `<{name}>` is not allowed in `<{parent}>`"),
    "unknown-attribute": Code("SW0805", "error", "`<{element}>` has no attribute `{name}`"),
    "missing-attribute": Code("SW0806", "error", "`<{element}>` needs attribute `{name}`"),
    "bad-value": Code("SW0807", "error", "`{name}` must be {values}"),
    "not-understood": Code("SW0808", "error", "`{name}` is not supported: {reason}"),
    "foreign-element": Code(
        "SW0809", "warning", "`<{name}>` is not an SCXML element and is ignored"
    ),
    "bad-expression": Code("SW0810", "error", "invalid expression: {reason}"),
    "duplicate-id": Code("SW0811", "error", "duplicate id `{name}`"),
    "unknown-state": Code("SW0812", "error", "no state has the id `{name}`"),
    "illegal-structure": Code("SW0813", "error", "{fault}"),
    # ---- generators and output
    "unknown-target": Code("SW0901", "error", "no target called `{name}`"),
    "broken-generator": Code(
        "SW0902", "warning", "cannot load the generator of target `{name}`: {reason}"
    ),
    "unsupported-construct": Code(
        "SW0903", "error", "target `{target}` cannot express {construct}"
    ),
    "bad-option": Code("SW0904", "error", "target `{target}`: {fault}"),
    "bad-identifier": Code("SW0905", "error", "target `{target}` cannot use `{name}` as {use}"),
    "output-collision": Code("SW0906", "error", "two generated files have the same path: `{path}`"),
    "outside-output": Code(
        "SW0907", "error", "target `{target}` would write outside the output folder: `{path}`"
    ),
    "would-overwrite": Code("SW0908", "error", "refusing to overwrite `{path}`: {reason}"),
    "cannot-write": Code("SW0909", "error", "cannot write `{path}`: {reason}"),
    "nothing-to-generate": Code("SW0910", "warning", "target `{target}` found nothing to generate"),
    "target-left-out": Code("SW0911", "warning", "target `{target}` is skipped"),
    "generator-failed": Code(
        "SW0912", "error", "the generator of target `{target}` failed: {reason}"
    ),
    "profile-left-out": Code("SW0913", "warning", "`{path}` is not generated"),
    "complete-by-hand": Code(
        "SW0914", "warning", "the code generated from `{path}` must be completed by hand: {what}"
    ),
    "value-not-a-number": Code(
        "SW0915", "warning", "the CPSwarm code generator cannot read the value of {item}"
    ),
    "no-place": Code("SW0916", "warning", "target `{target}` cannot represent {what}"),
    "outdated-code": Code(
        "SW0917", "warning", "`{path}` is outdated: the model has changed since it was written"
    ),
    "edited-output": Code("SW0918", "warning", "generated file `{path}` has been edited"),
    "merge-conflict": Code(
        "SW0919", "error", "merge conflict in `{path}`: the generator changes edited lines"
    ),
    "stale-output": Code("SW0920", "error", "`{path}` {fault}: {way}"),
    "parked-code": Code("SW0921", "warning", "`{path}` is parked: it is no longer generated"),
    "renamed-element": Code("SW0922", "warning", "`{old}` seems to have been renamed to `{new}`"),
    "bad-rename": Code("SW0923", "error", "`{old}` cannot be renamed to `{new}`: {fault}"),
    "old-name": Code("SW0924", "warning", "`{path}` may still use the old name `{name}` here"),
    "no-source-map": Code("SW0925", "error", "no source map in `{path}`: {reason}"),
    "unreadable-list": Code(
        "SW0926", "error", "cannot read `{path}`, the list of generated files: {reason}"
    ),
    "interrupted-build": Code(
        "SW0927", "error", "a build into `{path}` was interrupted and is incomplete"
    ),
    "damaged-region": Code("SW0928", "warning", "damaged region in `{path}`: {fault}"),
    "other-model": Code(
        "SW0929", "warning", "the build removes {files} of model `{model}` from `{path}`"
    ),
    "several-publishers": Code(
        "SW0930", "warning", "several nodes publish commands on `{topic}`: {nodes}"
    ),
    # ---- simulation
    "nothing-to-simulate": Code("SW1001", "error", "no state machine to simulate"),
    "unclear-subject": Code("SW1002", "error", "more than one swarm or state machine to simulate"),
    "bad-event-line": Code("SW1003", "error", "invalid event line: {reason}"),
    "unheard-event": Code("SW1004", "warning", "no state waits for event `{name}`"),
    "no-param-value": Code("SW1005", "error", "param `{name}` of `{machine}` has no value"),
    "never-settles": Code(
        "SW1006", "error", "{who} does not reach a stable configuration at {time}"
    ),
    "failed-expression": Code("SW1007", "warning", "evaluation failed in `{machine}`: {reason}"),
    "missing-key": Code("SW1008", "error", "missing key `{name}`"),
    "too-many-members": Code("SW1009", "error", "{count} members are too many to simulate"),
    "bad-trace-line": Code("SW1010", "error", "invalid trace line: {reason}"),
    "trace-departs": Code("SW1011", "error", "{who} deviates from the model on {event} at {time}"),
    "ros2-unavailable": Code("SW1012", "error", "cannot follow ROS 2 nodes: {reason}"),
    "positions-left-out": Code(
        "SW1013", "warning", "the positions of `{name}` are left out: there is no NumPy"
    ),
    "no-such-world": Code("SW1014", "error", "there is no {kind} world here: it needs {what}"),
    "failed-model": Code("SW1015", "error", "the model of `{function}` fails at {time}: {reason}"),
    "bad-model": Code("SW1016", "error", "cannot load model `{name}`: {reason}"),
    "unfit-device": Code("SW1017", "error", "`{name}` of {owner} {reason}"),
    "no-positions": Code("SW1018", "error", "there is no map: `{name}` has no places here"),
    "empty-trace": Code("SW1019", "warning", "trace `{path}` has no lines: it says nothing"),
    "not-replayed": Code(
        "SW1020", "warning", "`{name}` counts robots near it: its lines are not compared"
    ),
    "no-ros": Code("SW1021", "error", "cannot serve the robots to nodes of ROS 2: {reason}"),
    "no-picture": Code("SW1022", "error", "there is no picture of the robots: {reason}"),
    "clocks-differ": Code("SW1023", "warning", "the clock of {who} differs: {reason}"),
    "unreadable-bag": Code("SW1024", "error", "cannot read the recording `{path}`: {reason}"),
    # ---- tests
    "failed-expectation": Code("SW1101", "error", "expected {expected}"),
    "no-tests": Code("SW1102", "error", "no test in `{path}`"),
    "impossible-step": Code("SW1103", "error", "{reason}"),
    "low-coverage": Code(
        "SW1104",
        "error",
        "the tests cover {reached} % of all states and transitions, but {wanted} % are required",
    ),
    # ---- import
    "malformed-xml": Code("SW1201", "warning", "invalid XML was repaired: {fault}"),
    "repaired-dialect": Code("SW1202", "warning", "{fault}"),
    "renamed": Code("SW1203", "warning", "`{name}` is renamed to `{new}`"),
    "left-out": Code("SW1204", "warning", "{what} is left out: {reason}"),
    "assumed": Code("SW1205", "warning", "{what}: {assumed} is assumed"),
    "open-outcome": Code(
        "SW1206", "warning", "no transition handles {outcomes} of `{state}`: the machine ends then"
    ),
    "not-json": Code("SW1207", "error", "invalid JSON: {reason}"),
    "not-adf": Code("SW1208", "error", "not an ADF or AMF file: {reason}"),
    "nothing-to-import": Code("SW1209", "error", "nothing to import in `{path}`"),
    "no-model": Code("SW1210", "error", "cannot create a model from `{path}`: {reason}"),
    "not-yaml": Code("SW1211", "error", "invalid YAML: {reason}"),
    "kept": Code("SW1212", "warning", "{what} is not updated: {reason}"),
    "sent-later": Code(
        "SW1216",
        "warning",
        "`{event}` is sent instead of raised, after the events already queued",
    ),
    "too-large": Code("SW1217", "error", "`{path}` is larger than {most} MB"),
    # ---- diagrams
    "nothing-to-draw": Code("SW1301", "error", "nothing to draw in {what}"),
    "unclear-diagram": Code("SW1302", "error", "cannot write {count} diagrams to {where}"),
    # ---- comparison
    "no-revision": Code("SW1401", "error", "cannot compare with `{name}`: {reason}"),
    # ---- new projects, changes of models
    "bad-name": Code("SW1501", "error", "`{name}` cannot be {what}"),
    "already-there": Code("SW1502", "error", "`{path}` already exists and is not empty"),
    "no-such-thing": Code("SW1503", "error", "the model declares nothing called `{name}`"),
    "unclear-name": Code("SW1504", "error", "`{name}` is ambiguous"),
    "cannot-rename": Code("SW1505", "error", "cannot rename {what}: {reason}"),
    "still-named": Code("SW1506", "warning", "the old name `{name}` is still used here"),
    "cannot-add": Code("SW1507", "error", "cannot add {what}: {reason}"),
    # ---- properties
    "unclear-property": Code("SW1601", "error", "{kind} `{name}` does not say what it is about"),
    "unnamed-robot": Code("SW1602", "error", "this does not say {which}"),
    "impossible-fact": Code("SW1603", "warning", "this can never hold: {reason}"),
    "misplaced-robots": Code("SW1604", "error", "`{name}` {fault}"),
    "bad-chance": Code("SW1605", "error", "{text} is not a probability"),
    "violated-property": Code("SW1606", "error", "property `{name}` is violated{who} at {time}"),
    "momentary-fact": Code("SW1607", "error", "`{kind}` is about what lasts; this only happens"),
    "foreign-fitness": Code(
        "SW1608", "error", "the measures of fitness `{name}` are about swarm `{other}`"
    ),
    "violated-in-runs": Code(
        "SW1609", "error", "property `{name}` is violated in {count} of {runs} runs"
    ),
    "refuted-chance": Code(
        "SW1610",
        "error",
        "property `{name}` is not true in at {bound} {probability} of all runs, after {runs} runs",
    ),
    "failed-runs": Code("SW1611", "error", "{count} of {runs} runs have no result: {reason}"),
    "lost-worker": Code("SW1612", "error", "a process ended by itself, after {runs} runs"),
    "no-histogram": Code("SW1613", "warning", "`{path}` is not written: no measure has a value"),
    "ignored-contract": Code("SW1614", "error", "contract `{contract}`: {states} {verb} `{event}`"),
    "unsafe-path": Code(
        "SW1615", "error", "contract `{contract}`: in `{state}`, `{event}` {fault}"
    ),
    "left-safe-state": Code(
        "SW1616", "warning", "contract `{contract}`: a robot leaves `{state}` by itself"
    ),
    "idle-contract": Code("SW1617", "warning", "contract `{name}` promises nothing: {reason}"),
    # ---- verification
    "refuted-property": Code("SW1701", "error", "property `{name}` does not hold{who}"),
    "stuck-swarm": Code("SW1702", "warning", "the swarm can get stuck: nothing goes on by itself"),
    "waiting-for-ever": Code("SW1703", "warning", "a {who} in `{name}` waits for ever"),
    "absent-state": Code("SW1704", "warning", "no {who} gets into `{name}` in this swarm"),
    "untaken-transition": Code("SW1705", "warning", "no {who} takes this transition in this swarm"),
    "unhandled-message": Code(
        "SW1706", "warning", "`{name}` is sent, but ignored whenever it arrives"
    ),
    "endless-reaction": Code("SW1707", "error", "`{name}` does not come to rest"),
    "failed-computation": Code("SW1708", "warning", "evaluation fails in `{name}`: {reason}"),
    "size-not-allowed": Code("SW1709", "error", "this swarm cannot have {count} `{role}`"),
    "endless-answers": Code("SW1710", "warning", "robots can answer `{name}` without end"),
    # ---- experiments
    "runs-there": Code("SW1801", "error", "`{path}` has runs already"),
    "no-store": Code("SW1802", "error", "cannot {use} runs in `{path}`: {reason}"),
    "no-engine": Code("SW1803", "error", "cannot run on `{address}`: {reason}"),
    "worker-refuses": Code("SW1804", "error", "a worker refuses the runs: {reason}"),
    "lost-workers": Code("SW1805", "error", "workers were lost {times} times: {reason}"),
    "nothing-to-optimize": Code("SW1806", "error", "swarm `{name}` has {reason}"),
    "no-candidate": Code("SW1807", "error", "no candidate is possible: {reason}"),
    "cannot-apply": Code("SW1808", "error", "cannot write the winner into `{name}`: {reason}"),
    "not-applied": Code("SW1809", "warning", "`{name}` is not changed: it is better as it is"),
    "missing-package": Code("SW1810", "error", "`{what}` needs package `{package}`"),
    "narrowed-range": Code(
        "SW1811",
        "warning",
        "`{name}` is searched in {taken}, not in {range}: the role is {allowed}",
    ),
    "no-point": Code("SW1812", "error", "{fault}: the front has {count}"),
    "no-factors": Code("SW1821", "error", "the experiment varies nothing"),
    "no-levels": Code("SW1822", "error", "factor `{name}` has no levels to combine"),
    "too-large-study": Code("SW1823", "error", "{count} are too many: at most {most}"),
    "no-such-measure": Code("SW1824", "error", "{owner} has no `{name}` to measure"),
    "unfit-level": Code("SW1825", "error", "`{name}` cannot be {value}: {reason}"),
    "unfit-message": Code("SW1831", "error", "this is no message of an optimizer: {reason}"),
    "no-fitness": Code("SW1832", "warning", "the candidate is out: {reason}"),
    "no-connection": Code("SW1833", "error", "cannot serve as `{address}`: {reason}"),
}
