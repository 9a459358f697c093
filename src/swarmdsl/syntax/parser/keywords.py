"""Keywords by role: made from grammar/*.tx by `make parser`, not to be edited."""

from __future__ import annotations

# Words that cannot be names.
RESERVED = frozenset(['aborted', 'action', 'actuator', 'after', 'and', 'behavior', 'choice', 'communication', 'connect', 'const', 'controller', 'do', 'done', 'else', 'endless', 'entry', 'enum', 'environment', 'event', 'exit', 'extends', 'false', 'final', 'fitness', 'function', 'gives', 'history', 'import', 'in', 'initial', 'inout', 'member', 'message', 'monitor', 'not', 'on', 'operation', 'optimize', 'or', 'out', 'package', 'parallel', 'param', 'preempted', 'property', 'region', 'self', 'send', 'sensor', 'service', 'state', 'statemachine', 'struct', 'succeeded', 'swarm', 'true', 'type', 'var', 'virtual'])
# Words that are keywords only where the grammar expects them, with a pattern of what follows them.
CONTEXTUAL = {
    'abstraction': '[{]',
    'again': '[*A-Za-z_0-9"]',
    'all': '[A-Za-z_]',
    'always': '(?:possible)\\b',
    'append': '[A-Za-z_0-9"-]',
    'area': '[A-Za-z_]',
    'as': '[A-Za-z_]',
    'at': '(?:(?:all|least|most|random)\\b|[(])',
    'battery': '[{]',
    'before': '[*A-Za-z_0-9"]',
    'best': '(?:effort)\\b',
    'between': '[*A-Za-z_0-9"]',
    'body': '[{]',
    'by': '[A-Za-z_0-9"-]',
    'cancel': '[A-Za-z_]',
    'cancels': '[A-Za-z_]',
    'clear': '[A-Za-z_0-9"-]',
    'count': '(?:(?:of)\\b|[(])',
    'covered': '[(]',
    'deadline': '[A-Za-z_0-9"-]',
    'deep': '(?:history)\\b',
    'defer': '[A-Za-z_]',
    'distance': '[(]',
    'each': '[A-Za-z_]',
    'effort': '(?:[,;}]|$)',
    'ends': '[A-Za-z_]',
    'energy': '[(]',
    'evaluations': '[A-Za-z_0-9"-]',
    'eventually': '[*A-Za-z_0-9"]',
    'feedback': '[{]',
    'found': '[(]',
    'from': '[A-Za-z_0-9"-]',
    'goal': '[{]',
    'has': '[\\[]',
    'hears': '[A-Za-z_]',
    'heartbeat': '[A-Za-z_0-9"-]',
    'height': '[A-Za-z_0-9"-]',
    'internal': '(?:(?:after|monitor|on)\\b|[\\[])',
    'keep': '[A-Za-z_0-9"-]',
    'latest': '(?:[,;}]|$)',
    'leads': '(?:to)\\b',
    'least': '[0-9"]',
    'lifespan': '[A-Za-z_0-9"-]',
    'lost': '(?:after)\\b',
    'max': '(?:count|each)\\b',
    'maximize': '[A-Za-z_0-9"-]',
    'mean': '(?:count|each)\\b',
    'min': '(?:count|each)\\b',
    'minimize': '[A-Za-z_0-9"-]',
    'model': '[A-Za-z_]',
    'most': '[0-9"]',
    'neighbors': '(?:within)\\b',
    'never': '[*A-Za-z_0-9"]',
    'no': '[A-Za-z_]',
    'obstacle': '[A-Za-z_]',
    'of': '[A-Za-z_]',
    'only': '(?:after)\\b',
    'other': '[A-Za-z_]',
    'possible': '[*A-Za-z_0-9"]',
    'radio': '[{]',
    'radius': '[A-Za-z_0-9"-]',
    'rain': '(?:from|until)\\b',
    'random': '(?:in)\\b',
    'reliable': '(?:[,;}]|$)',
    'remove': '[A-Za-z_0-9"-]',
    'request': '[{]',
    'response': '[{]',
    'result': '[{]',
    'ros': '[0-9"]',
    'seed': '[A-Za-z_0-9"-]',
    'sends': '[A-Za-z_]',
    'senses': '[A-Za-z_]',
    'size': '[0-9"]',
    'some': '[A-Za-z_]',
    'starts': '[A-Za-z_]',
    'step': '[A-Za-z_0-9"-]',
    'steps': '[A-Za-z_0-9"-]',
    'subject': '(?:to)\\b',
    'sum': '(?:each)\\b',
    'target': '[A-Za-z_]',
    'then': '[*A-Za-z_0-9"]',
    'time': '(?:(?:until)\\b|[(])',
    'times': '(?:[,;}]|$)',
    'to': '[*A-Za-z_0-9"-]',
    'total': '[(]',
    'until': '[*A-Za-z_0-9"-]',
    'wall': '[:]',
    'where': '[A-Za-z_0-9"-]',
    'wind': '[A-Za-z_0-9"-]',
    'within': '[A-Za-z_0-9"-]',
    'world': '[0-9"]',
    'x': '[0-9"]',
    'zone': '[A-Za-z_]',
}
# The first keywords of the alternatives of a rule.
FIRST = {
    'ComponentItem': frozenset(['behavior', 'in', 'inout', 'operation', 'out', 'param', 'senses']),
    'Declaration': frozenset(['action', 'actuator', 'const', 'controller', 'endless', 'enum', 'environment', 'event', 'fitness', 'function', 'member', 'message', 'property', 'sensor', 'service', 'statemachine', 'struct', 'swarm', 'type', 'virtual']),
    'Effect': frozenset(['append', 'cancel', 'clear', 'event', 'false', 'in', 'neighbors', 'not', 'remove', 'self', 'send', 'true']),
    'EnvironmentItem': frozenset(['area', 'obstacle', 'rain', 'size', 'target', 'wall', 'wind', 'world', 'zone']),
    'FitnessItem': frozenset(['in', 'maximize', 'minimize', 'param']),
    'FunctionItem': frozenset(['action', 'in', 'model', 'out', 'param', 'service']),
    'Import': frozenset(['import']),
    'MachineItem': frozenset(['choice', 'deep', 'final', 'history', 'initial', 'parallel', 'param', 'state', 'var']),
    'MemberItem': frozenset(['battery', 'behavior', 'body', 'communication', 'connect', 'in', 'inout', 'out', 'param', 'radio']),
    'Optimization': frozenset(['optimize']),
    'OptimizationItem': frozenset(['count', 'evaluations', 'seed', 'steps', 'subject']),
    'Package': frozenset(['package']),
    'ParallelItem': frozenset(['after', 'defer', 'entry', 'exit', 'internal', 'monitor', 'on', 'region', 'var']),
    'PropertySubject': frozenset(['endless', 'statemachine', 'swarm']),
    'RegionItem': frozenset(['choice', 'deep', 'final', 'history', 'initial', 'parallel', 'state', 'var']),
    'StateItem': frozenset(['after', 'choice', 'deep', 'defer', 'do', 'entry', 'exit', 'final', 'history', 'initial', 'internal', 'monitor', 'on', 'parallel', 'state', 'var']),
    'SwarmItem': frozenset(['environment', 'fitness', 'heartbeat']),
    'Trigger': frozenset(['aborted', 'done', 'preempted', 'succeeded']),
    'Vertex': frozenset(['choice', 'deep', 'final', 'history', 'parallel', 'state']),
}
# Keywords of sections of a file: of its header, its declarations, its optimizations.
TOP_LEVEL = frozenset(['action', 'actuator', 'const', 'controller', 'endless', 'enum', 'environment', 'event', 'fitness', 'function', 'import', 'member', 'message', 'optimize', 'package', 'property', 'sensor', 'service', 'statemachine', 'struct', 'swarm', 'type', 'virtual'])
# Keywords of items in blocks that begin a statement anywhere on a line.
STATEMENTS = frozenset(['after', 'behavior', 'choice', 'communication', 'connect', 'deep', 'do', 'entry', 'exit', 'final', 'history', 'initial', 'internal', 'monitor', 'on', 'operation', 'parallel', 'param', 'region', 'state', 'var'])
# Keywords before the keyword of a statement, by the keywords that can follow them.
MODIFIERS = {
    'deep': frozenset(['history']),
    'endless': frozenset(['statemachine']),
    'internal': frozenset(['after', 'monitor', 'on']),
    'parallel': frozenset(['state']),
    'swarm': frozenset(['event']),
}
# Keywords of optional clauses, by the first keywords of the statements that have them.
CLAUSES = {
    'after': frozenset(['property', 'send']),
    'extends': frozenset(['actuator', 'controller', 'member', 'sensor', 'virtual']),
    'gives': frozenset(['do']),
    'in': frozenset(['target']),
    'on': frozenset(['event', 'in', 'inout', 'out', 'swarm']),
}
# Keywords that the name of a new element follows.
NAMING = frozenset(['actuator', 'choice', 'communication', 'const', 'controller', 'enum', 'environment', 'event', 'final', 'fitness', 'function', 'history', 'member', 'model', 'operation', 'property', 'region', 'sensor', 'state', 'statemachine', 'struct', 'type', 'virtual'])
# Keywords by what they are for, where that is more special than a declaration.
GROUPS = {
    'include': frozenset(['import', 'package', 'ros']),
    'statement': frozenset(['after', 'as', 'best', 'by', 'count', 'deadline', 'do', 'done', 'effort', 'else', 'evaluations', 'gives', 'in', 'internal', 'keep', 'latest', 'lifespan', 'maximize', 'minimize', 'monitor', 'of', 'on', 'reliable', 'seed', 'send', 'size', 'step', 'steps', 'subject', 'to', 'world', 'x']),
    'outcome': frozenset(['aborted', 'preempted', 'succeeded']),
    'operator': frozenset(['and', 'not', 'or']),
    'boolean': frozenset(['false', 'true']),
}
# Keywords of declarations that can follow `:`, as categories.
CATEGORIES = frozenset(['swarm'])
# Keywords that a name can follow.
BEFORE_NAMES = frozenset(['action', 'actuator', 'after', 'again', 'all', 'and', 'append', 'area', 'as', 'before', 'behavior', 'between', 'by', 'cancel', 'cancels', 'choice', 'clear', 'communication', 'connect', 'const', 'controller', 'deadline', 'defer', 'do', 'each', 'ends', 'enum', 'environment', 'evaluations', 'event', 'eventually', 'extends', 'final', 'fitness', 'from', 'function', 'hears', 'heartbeat', 'height', 'history', 'import', 'in', 'initial', 'inout', 'keep', 'lifespan', 'maximize', 'member', 'message', 'minimize', 'model', 'never', 'no', 'not', 'obstacle', 'of', 'on', 'operation', 'optimize', 'or', 'other', 'out', 'package', 'param', 'possible', 'property', 'radius', 'region', 'remove', 'seed', 'send', 'sends', 'senses', 'sensor', 'service', 'some', 'starts', 'state', 'statemachine', 'step', 'steps', 'struct', 'swarm', 'target', 'then', 'to', 'type', 'until', 'var', 'virtual', 'where', 'wind', 'within', 'zone'])
