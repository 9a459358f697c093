"""The catalogue of diagnostics: every code there is.

Each has a page in `explain/` (printed by `swarmc explain CODE`) and a case in
`tests/diagnostics/`. A number is never used again for something else.

    00xx  files and imports      04xx  components, ports, connectors
    01xx  syntax                 05xx  state machines
    02xx  names                  06xx  functions and interfaces
    03xx  swarm composition      07xx  expressions
    08xx  SCXML documents        09xx  generators and output
    10xx  simulation             11xx  tests
    12xx  import                 13xx  diagrams
    14xx  comparison             15xx  new projects, changes of models
"""

# The annotations here are values: typing would compile texts one by one.
from typing import NamedTuple


class Code(NamedTuple):
    """One kind of diagnostic; `message` is filled in with `str.format`.

    A `silent` warning is reported only to whoever asks for it by its name.
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
    "empty-file": Code("SW0005", "error", "nothing is declared in this file"),
    "import-cycle": Code("SW0006", "error", "`{path}` imports itself"),
    "nothing-to-compile": Code("SW0007", "error", "no .swarm file in `{path}`"),
    "unknown-package": Code("SW0008", "error", "no library has a package `{name}`"),
    "control-character": Code("SW0009", "error", "there is a control character, {code}, here"),
    "broken-library": Code("SW0010", "warning", "the library `{name}` does not work: {reason}"),
    "bad-toml": Code("SW0011", "error", "`{path}` is not TOML: {reason}"),
    "unknown-key": Code("SW0012", "error", "{owner} has no `{name}`"),
    "wrong-value": Code("SW0013", "error", "`{name}` takes {expected}, not {found}"),
    "unknown-diagnostic": Code("SW0014", "error", "there is no diagnostic `{name}`"),
    "not-a-warning": Code("SW0015", "error", "`{name}` is an error, and cannot be allowed"),
    "outside-workspace": Code("SW0016", "error", "`{path}` is outside of the workspace"),
    # ---- syntax
    "syntax-error": Code("SW0101", "error", "{message}"),
    "unclosed-bracket": Code("SW0102", "error", "this `{bracket}` is never closed"),
    "keyword-as-name": Code("SW0103", "error", "`{word}` is a keyword and cannot be a name"),
    "nested-too-deeply": Code("SW0104", "error", "nested deeper than {limit} levels"),
    "unattached-doc-comment": Code(
        "SW0105", "warning", "this `///` comment stands before nothing that can be documented"
    ),
    "unterminated-text": Code("SW0106", "error", 'this text has no closing `"`'),
    "unterminated-comment": Code("SW0107", "error", "this comment has no closing `*/`"),
    # ---- names
    "duplicate-name": Code("SW0201", "error", "{kind} `{name}` is declared twice"),
    "unresolved-name": Code("SW0202", "error", "no {kind} called `{name}`"),
    "ambiguous-name": Code("SW0203", "error", "`{name}` could mean several things here"),
    "wrong-kind": Code("SW0204", "error", "`{name}` is {actual}, not {expected}"),
    "reserved-event-name": Code("SW0205", "error", "an event cannot be called `{name}`"),
    "naming-style": Code("SW0206", "warning", "{kind} `{name}` is not in {style}"),
    "unused-declaration": Code("SW0207", "warning", "{kind} `{name}` is never used", silent=True),
    # ---- swarm composition
    "empty-multiplicity": Code("SW0301", "error", "the multiplicity `{multiplicity}` {fault}"),
    "empty-swarm": Code("SW0302", "error", "swarm `{name}` has no member"),
    "impossible-size": Code("SW0303", "error", "the size `{size}` {fault}"),
    "missing-objective": Code("SW0304", "error", "fitness `{name}` has no objective"),
    "empty-range": Code("SW0305", "error", "this range {fault}"),
    "impossible-setting": Code("SW0306", "error", "`{name}` must be at least {least}"),
    "default-outside": Code("SW0307", "warning", "the default of `{name}` is not in this range"),
    "empty-optimization": Code("SW0308", "warning", "nothing in swarm `{name}` is varied"),
    "missing-fitness": Code("SW0309", "error", "swarm `{name}` is optimized without a fitness"),
    # ---- components, ports, connectors
    "port-direction": Code("SW0401", "error", "{fault}"),
    "port-type-mismatch": Code(
        "SW0402", "error", "`{source}` sends {sent}, `{target}` takes {taken}"
    ),
    "unknown-param": Code("SW0403", "error", "{owner} has no param `{name}`"),
    "repeated-item": Code("SW0404", "error", "{item} is given twice"),
    "inheritance-cycle": Code("SW0405", "error", "`{name}` extends itself"),
    "unknown-setting": Code("SW0406", "error", "there is no setting `{name}`"),
    "unconnected-port": Code("SW0407", "warning", "nothing is connected to `{port}`"),
    "driven-twice": Code("SW0408", "warning", "`{port}` gets data from two connectors"),
    "shared-topic": Code("SW0409", "warning", "two connections share topic `{topic}`"),
    "replaced-topic": Code(
        "SW0410", "warning", "a connector puts `{port}` on topic `{topic}`, not on `{own}`"
    ),
    # ---- state machines
    "missing-initial": Code("SW0501", "error", "{owner} has no initial state"),
    "missing-final": Code("SW0502", "error", "{owner} has no final state"),
    "unreachable-state": Code("SW0503", "warning", "{kind} `{name}` can never be reached"),
    "transition-never-fires": Code("SW0504", "warning", "this transition can never fire"),
    "unhandled-outcome": Code("SW0505", "error", "nothing handles {outcomes} of `{function}`"),
    "submachine-cycle": Code("SW0506", "error", "state machine `{name}` contains itself"),
    "outcome-without-activity": Code(
        "SW0507", "error", "state `{state}` does nothing that could end as `{outcome}`"
    ),
    "done-without-content": Code("SW0508", "error", "{owner} can never be done"),
    "target-outside": Code("SW0509", "error", "`{target}` cannot be reached from here: {reason}"),
    "choice-without-else": Code("SW0510", "error", "choice `{name}` has no `else`"),
    "mixed-content": Code("SW0511", "error", "state `{state}` has {content}"),
    "missing-value": Code("SW0512", "error", "param `{name}` of `{machine}` has no value"),
    "too-few-regions": Code("SW0513", "error", "parallel state `{name}` has no region"),
    "too-many-states": Code(
        "SW0514", "error", "state machine `{name}` has more than {limit} states"
    ),
    "endless-steps": Code("SW0515", "error", "`{name}` leads back to itself without waiting"),
    "misplaced-internal": Code(
        "SW0516", "error", "an internal transition of `{state}` cannot lead to `{target}`"
    ),
    "misplaced-history": Code("SW0517", "error", "history `{name}` {fault}"),
    "negative-delay": Code("SW0518", "error", "a delay cannot be negative"),
    "constant-guard": Code("SW0519", "warning", "this guard {held} holds"),
    "idle-variable": Code("SW0520", "warning", "variable `{name}` {fault}"),
    "unhandled-event": Code("SW0521", "warning", "nothing{where} waits for event `{name}`"),
    "conflicting-regions": Code("SW0522", "warning", "{event} leads out of `{state}` in two ways"),
    "unsent-event": Code("SW0523", "warning", "nothing{where} sends event `{name}`", silent=True),
    "choice-circle": Code(
        "SW0524", "warning", "choice `{name}` leads back to itself through choices only"
    ),
    "early-read": Code("SW0525", "warning", "variable `{name}` may be read before it is written"),
    "zero-delay": Code("SW0526", "warning", "a delay of 0 waits for nothing"),
    "repeated-trigger": Code("SW0527", "warning", "`{trigger}` triggers this transition already"),
    "conflicting-effects": Code(
        "SW0528", "warning", "two regions assign to `{variable}` on {event}"
    ),
    # ---- functions and interfaces
    "unknown-field": Code("SW0601", "error", "{owner} has no field `{name}`"),
    "missing-field": Code("SW0602", "error", "{owner} needs a value for {fields}"),
    "unbound-function": Code(
        "SW0603", "error", "function `{name}` offers no action and no service"
    ),
    "interface-kind": Code("SW0604", "error", "`{name}` is {actual}, not {expected}"),
    "type-cycle": Code("SW0605", "error", "type `{name}` is defined by itself"),
    "nested-array": Code("SW0606", "error", "ROS has no arrays of arrays"),
    "shared-callback": Code("SW0607", "error", "callback `{name}` serves two functions"),
    "impossible-array": Code("SW0608", "error", "{what} cannot have {size}"),
    "enum-value": Code("SW0609", "error", "value `{name}` of enum `{enum}` {fault}"),
    "unknown-interface": Code("SW0610", "warning", "nothing is known of `{name}`"),
    "bad-topic": Code("SW0611", "error", "`{name}` cannot be the name of {what} in ROS"),
    "topic-types": Code("SW0612", "error", "topic `{topic}` carries `{first}`, not `{second}`"),
    "empty-enum": Code("SW0613", "error", "enum `{name}` has no value"),
    "no-first-value": Code(
        "SW0614", "warning", "variable `{name}` begins as 0, which is no value of enum `{enum}`"
    ),
    "other-than-standard": Code("SW0615", "warning", "ROS comes with another `{name}`"),
    "undescribed-interface": Code("SW0616", "warning", "nothing describes `{name}`", silent=True),
    # ---- expressions
    "type-mismatch": Code("SW0701", "error", "expected {expected}, found {found}"),
    "bad-operand": Code("SW0702", "error", "`{operator}` does not work on {operands}"),
    "not-assignable": Code("SW0703", "error", "`{text}` cannot be assigned to"),
    "not-constant": Code("SW0704", "error", "the value must be known when the model is compiled"),
    "no-event-data": Code("SW0705", "error", "`event` has no data here"),
    "constant-cycle": Code("SW0706", "error", "constant `{name}` is defined by itself"),
    "no-result": Code("SW0707", "error", "`{operator}` has no result: {fault}"),
    # ---- SCXML documents
    "not-xml": Code("SW0801", "error", "this is not XML: {reason}"),
    "xml-document-type": Code("SW0802", "error", "the document type is not read"),
    "not-scxml": Code("SW0803", "error", "this is no SCXML document: it begins with `{name}`"),
    "unknown-element": Code("SW0804", "error", "there is no `<{name}>` in `<{parent}>`"),
    "unknown-attribute": Code("SW0805", "error", "`<{element}>` has no `{name}`"),
    "missing-attribute": Code("SW0806", "error", "`<{element}>` needs `{name}`"),
    "bad-value": Code("SW0807", "error", "`{name}` can only be {values}"),
    "not-understood": Code("SW0808", "error", "`{name}` is not understood: {reason}"),
    "foreign-element": Code("SW0809", "warning", "`<{name}>` is no SCXML and is passed over"),
    "bad-expression": Code("SW0810", "error", "this expression is not understood: {reason}"),
    "duplicate-id": Code("SW0811", "error", "the id `{name}` is given twice"),
    "unknown-state": Code("SW0812", "error", "no state has the id `{name}`"),
    "illegal-structure": Code("SW0813", "error", "{fault}"),
    # ---- generators and output
    "unknown-target": Code("SW0901", "error", "no target called `{name}`"),
    "broken-generator": Code(
        "SW0902", "warning", "the generator of target `{name}` does not work: {reason}"
    ),
    "unsupported-construct": Code(
        "SW0903", "error", "target `{target}` cannot express {construct}"
    ),
    "bad-option": Code("SW0904", "error", "target `{target}`: {fault}"),
    "bad-identifier": Code("SW0905", "error", "target `{target}` cannot use `{name}` as {use}"),
    "output-collision": Code("SW0906", "error", "two things would be written to `{path}`"),
    "outside-output": Code(
        "SW0907", "error", "target `{target}` wants to write outside the output folder: `{path}`"
    ),
    "would-overwrite": Code("SW0908", "error", "`{path}` would be overwritten, but {reason}"),
    "cannot-write": Code("SW0909", "error", "cannot write `{path}`: {reason}"),
    "nothing-to-generate": Code("SW0910", "warning", "target `{target}` found nothing to generate"),
    "target-left-out": Code("SW0911", "warning", "target `{target}` is left out"),
    "generator-failed": Code(
        "SW0912", "error", "the generator of target `{target}` does not work: {reason}"
    ),
    "profile-left-out": Code("SW0913", "warning", "`{path}` is left out"),
    "complete-by-hand": Code(
        "SW0914", "warning", "the code generated from `{path}` needs a line by hand: {what}"
    ),
    "value-not-a-number": Code(
        "SW0915", "warning", "the CPSwarm code generator cannot read the value of {item}"
    ),
    "no-place": Code("SW0916", "warning", "target `{target}` has no place for {what}"),
    "outdated-code": Code(
        "SW0917", "warning", "`{path}` is written for another state of the model"
    ),
    "edited-output": Code("SW0918", "warning", "`{path}` is generated, and has been edited"),
    "merge-conflict": Code(
        "SW0919", "error", "`{path}` has been edited where what is generated changes"
    ),
    "stale-output": Code("SW0920", "error", "`{path}` {fault}: {way}"),
    "parked-code": Code(
        "SW0921", "warning", "`{path}` is put aside: nothing is generated for it any more"
    ),
    "renamed-element": Code("SW0922", "warning", "`{new}` looks like `{old}` under another name"),
    "bad-rename": Code("SW0923", "error", "`{old}` cannot be renamed to `{new}`: {fault}"),
    "old-name": Code("SW0924", "warning", "`{path}` may still mean `{name}` here"),
    "no-source-map": Code("SW0925", "error", "no source map in `{path}`: {reason}"),
    "unreadable-list": Code(
        "SW0926", "error", "cannot read `{path}`, the list of generated files: {reason}"
    ),
    "interrupted-build": Code(
        "SW0927", "error", "a build into `{path}` was interrupted, and is not complete"
    ),
    "damaged-region": Code("SW0928", "warning", "in `{path}`, {fault}"),
    "other-model": Code(
        "SW0929", "warning", "`{path}` loses {files} of model `{model}`, which was built into it"
    ),
    # ---- simulation
    "nothing-to-simulate": Code("SW1001", "error", "there is no state machine to simulate"),
    "unclear-subject": Code("SW1002", "error", "there is more than one thing to simulate"),
    "bad-event-line": Code("SW1003", "error", "this line is no event: {reason}"),
    "unheard-event": Code("SW1004", "warning", "no state waits for event `{name}`"),
    "no-param-value": Code("SW1005", "error", "param `{name}` of `{machine}` has no value"),
    "never-settles": Code("SW1006", "error", "{who} does not come to rest at {time}"),
    "failed-expression": Code("SW1007", "warning", "a value in `{machine}` failed: {reason}"),
    "missing-key": Code("SW1008", "error", "this needs `{name}`"),
    "too-many-members": Code("SW1009", "error", "{count} members are too many to simulate"),
    "bad-trace-line": Code("SW1010", "error", "this line is none of a trace: {reason}"),
    "trace-departs": Code("SW1011", "error", "{who} leaves the model on {event} at {time}"),
    "ros2-unavailable": Code("SW1012", "error", "ROS 2 cannot be followed: {reason}"),
    # ---- tests
    "failed-expectation": Code("SW1101", "error", "expected {expected}"),
    "no-tests": Code("SW1102", "error", "no test in `{path}`"),
    "impossible-step": Code("SW1103", "error", "{reason}"),
    "low-coverage": Code(
        "SW1104",
        "error",
        "the tests reach {reached} % of all states and transitions, not {wanted} %",
    ),
    # ---- import
    "malformed-xml": Code("SW1201", "warning", "this is not XML, and was repaired: {fault}"),
    "repaired-dialect": Code("SW1202", "warning", "{fault}"),
    "renamed": Code("SW1203", "warning", "`{name}` is called `{new}` in the model"),
    "left-out": Code("SW1204", "warning", "{what} is left out: {reason}"),
    "assumed": Code("SW1205", "warning", "{what}: {assumed} is assumed"),
    "open-outcome": Code(
        "SW1206", "warning", "nothing handles {outcomes} of `{state}`: the machine ends then"
    ),
    "not-json": Code("SW1207", "error", "this is not JSON: {reason}"),
    "not-adf": Code("SW1208", "error", "this is no ADF or AMF file: {reason}"),
    "nothing-to-import": Code(
        "SW1209", "error", "`{path}` has nothing that a model could be made of"
    ),
    "no-model": Code("SW1210", "error", "no model can be made of `{path}`: {reason}"),
    "not-yaml": Code("SW1211", "error", "this is not YAML: {reason}"),
    "kept": Code("SW1212", "warning", "{what} stays as it is: {reason}"),
    "sent-later": Code(
        "SW1216",
        "warning",
        "`{event}` is sent here: it comes after the events that wait already",
    ),
    "too-large": Code("SW1217", "error", "`{path}` has more than {most} MB"),
    # ---- diagrams
    "nothing-to-draw": Code("SW1301", "error", "the model has nothing for {what}"),
    "unclear-diagram": Code("SW1302", "error", "{count} diagrams do not go to {where}"),
    # ---- comparison
    "no-revision": Code("SW1401", "error", "cannot compare with `{name}`: {reason}"),
    # ---- new projects, changes of models
    "bad-name": Code("SW1501", "error", "`{name}` cannot be {what}"),
    "already-there": Code("SW1502", "error", "`{path}` is there already, and has something in it"),
    "no-such-thing": Code("SW1503", "error", "the model declares nothing called `{name}`"),
    "unclear-name": Code("SW1504", "error", "several things are called `{name}`"),
    "cannot-rename": Code("SW1505", "error", "{what} keeps its name: {reason}"),
    "still-named": Code("SW1506", "warning", "`{name}` stands here still"),
    "cannot-add": Code("SW1507", "error", "{what} is not added: {reason}"),
}
