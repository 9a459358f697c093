"""Parses .swarm files: made from grammar/*.tx by `make parser`, not to be edited."""

# mypy: ignore-errors
from __future__ import annotations

import re

from swarmdsl.syntax.parser.expressions import ExpressionParser, TooDeepError
from swarmdsl.syntax.parser.literals import Language, unquoted
from swarmdsl.base.source import Source, Span
from swarmdsl.syntax.ast import Ref, Word, ActionType, Activity, Address, AliasType, Argument, Assignment, BehaviorUse, Branch, Choice, Communication, CommunicationSettings, Component, Connector, Constant, CountRange, DoneTrigger, Entry, EnumType, EnumValue, Environment, EnvironmentUse, Event, EventTrigger, Exit, Field, FinalState, Fitness, FitnessInput, FitnessUse, Function, FunctionPort, History, ImportFile, ImportLibrary, ImportRos, Initial, Member, MessageType, Model, MonitorTrigger, Multiplicity, Objective, Operation, Optimization, OutcomeTrigger, Package, Parallel, Param, ParamRange, Parameter, Part, PartValue, Port, PortRef, Region, ResultMapping, RobotValues, Role, Send, ServiceType, Setting, Size, State, StateMachine, StructType, Swarm, TimeTrigger, Transition, TypeRef, Variable, World
from swarmdsl.syntax.parser.lexer import Lexer

GRAMMAR = 2987401596
new_node = object.__new__
new_span = tuple.__new__
new_word = str.__new__

BLANK = '[\\\t\\\n\\\r\\ ]*(?:(?:\\/\\/[^\\n]*|\\/\\*(?:[^*]|\\*(?!\\/))*\\*\\/)[\\\t\\\n\\\r\\ ]*)*'
BLANKS = re.compile(BLANK).match
LEXER = Lexer('\t\n\r ', re.compile('[\\\t\\\n\\\r\\ ]*(?:(?:\\/\\/[^\\n]*|\\/\\*(?:[^*]|\\*(?!\\/))*\\*\\/)[\\\t\\\n\\\r\\ ]*(?:(?:\\/\\/[^\\n]*|\\/\\*(?:[^*]|\\*(?!\\/))*\\*\\/)[\\\t\\\n\\\r\\ ]*)*|)(?:[^\\x00-@\\[-^`{-\\x7f][^\\x00-/:-@\\[-^`{-\\x7f]*|[0-9]+(?:\\.[0-9]+)?[^\\x00-/:-@\\[-^`{-\\x7f]*|"(?:[^"\\\\\\n]|\\\\[^\\n])*"|/\\*(?s:.*\\S)?|(?s:.)|\\Z)').findall, BLANKS)

def REGEX0(text, at):
    global REGEX0
    REGEX0 = re.compile('(?:\\.[A-Za-z_][A-Za-z0-9_]*\\b)*', re.MULTILINE).match
    return REGEX0(text, at)


def REGEX1(text, at):
    global REGEX1
    REGEX1 = re.compile('"(?:[^"\\\\\\n]|\\\\[^\\n])*"', re.MULTILINE).match
    return REGEX1(text, at)


def REGEX2(text, at):
    global REGEX2
    REGEX2 = re.compile('(?:\\.[A-Za-z_][A-Za-z0-9_]*\\b)*(?:\\.\\*)?', re.MULTILINE).match
    return REGEX2(text, at)


def REGEX3(text, at):
    global REGEX3
    REGEX3 = re.compile('(?:\\/[A-Za-z_][A-Za-z0-9_]*\\b)?', re.MULTILINE).match
    return REGEX3(text, at)


def REGEX4(text, at):
    global REGEX4
    REGEX4 = re.compile('(?:[.\\/][A-Za-z_][A-Za-z0-9_]*\\b)*', re.MULTILINE).match
    return REGEX4(text, at)


def REGEX5(text, at):
    global REGEX5
    REGEX5 = re.compile('<=?\\s*-?\\d+\\b', re.MULTILINE).match
    return REGEX5(text, at)


def REGEX6(text, at):
    global REGEX6
    REGEX6 = re.compile('(?:\\[\\s*(?:<=?\\s*)?(?:-?\\d[\\d.]*|\\*)?\\s*\\])+', re.MULTILINE).match
    return REGEX6(text, at)


def REGEX7(text, at):
    global REGEX7
    REGEX7 = re.compile('-?\\d+\\b(?!\\.\\d)', re.MULTILINE).match
    return REGEX7(text, at)


def REGEX8(text, at):
    global REGEX8
    REGEX8 = re.compile('(?!(?:aborted|action|actuator|after|and|behavior|choice|communication|connect|const|controller|do|done|else|endless|entry|enum|environment|event|exit|extends|false|final|fitness|function|gives|history|import|in|initial|inout|member|message|monitor|not|on|operation|optimize|or|out|package|parallel|param|preempted|region|self|send|sensor|service|state|statemachine|struct|succeeded|swarm|true|type|var|virtual)\\b)[A-Za-z_][A-Za-z0-9_]*\\b|[A-Za-z_][A-Za-z0-9_]*\\b(?=[ \\t]*(?:->|[:;}\\r\\n]|\\/[\\/*]|$))', re.MULTILINE).match
    return REGEX8(text, at)


def REGEX9(text, at):
    global REGEX9
    REGEX9 = re.compile('\\d+\\b', re.MULTILINE).match
    return REGEX9(text, at)


def REGEX10(text, at):
    global REGEX10
    REGEX10 = re.compile('\\d+(?:\\.\\d+)?[ \\t]*(?:km|cm|mm|m)\\b', re.MULTILINE).match
    return REGEX10(text, at)


def REGEX11(text, at):
    global REGEX11
    REGEX11 = re.compile('\\d+\\b|\\*', re.MULTILINE).match
    return REGEX11(text, at)


def REGEX12(text, at):
    global REGEX12
    REGEX12 = re.compile('(?<=[A-Za-z0-9_])(?=\\[)', re.MULTILINE).match
    return REGEX12(text, at)

SET0 = frozenset(['action', 'actuator', 'const', 'controller', 'endless', 'enum', 'environment', 'event', 'fitness', 'function', 'member', 'message', 'optimize', 'sensor', 'service', 'statemachine', 'struct', 'swarm', 'type', 'virtual'])
SET1 = frozenset(['action', 'actuator', 'const', 'controller', 'endless', 'enum', 'environment', 'event', 'fitness', 'function', 'member', 'message', 'sensor', 'service', 'statemachine', 'struct', 'swarm', 'type', 'virtual'])
SET2 = frozenset(['!', '#', '$', '%', '&', "'", '(', ')', '*', '+', ',', '-', '.', '/', ':', ';', '<', '=', '>', '?', '@', '[', '\\', ']', '^', '`', 'aborted', 'action', 'actuator', 'after', 'and', 'behavior', 'choice', 'communication', 'connect', 'const', 'controller', 'do', 'done', 'else', 'endless', 'entry', 'enum', 'environment', 'event', 'exit', 'extends', 'false', 'final', 'fitness', 'function', 'gives', 'history', 'import', 'in', 'initial', 'inout', 'member', 'message', 'monitor', 'not', 'on', 'operation', 'optimize', 'or', 'out', 'package', 'parallel', 'param', 'preempted', 'region', 'self', 'send', 'sensor', 'service', 'state', 'statemachine', 'struct', 'succeeded', 'swarm', 'true', 'type', 'var', 'virtual', '{', '|', '}', '~', '\x7f'])
SET3 = frozenset(['!', '#', '$', '%', '&', "'", '(', ')', '*', '+', ',', '-', '.', '/', ':', ';', '<', '=', '>', '?', '@', '[', '\\', ']', '^', '`', '{', '|', '}', '~', '\x7f'])
SET4 = frozenset([',', ';'])
SET5 = frozenset(['abstraction', 'swarm'])
SET6 = frozenset(['action', 'in', 'out', 'param', 'service'])
SET7 = frozenset(['behavior', 'in', 'inout', 'operation', 'out', 'param'])
SET8 = frozenset(['!', '#', '$', '%', '&', "'", '(', ')', '*', '+', ',', '-', '.', '/', ':', ';', '<', '=', '>', '?', '@', '[', '\\', ']', '^', '`', 'aborted', 'action', 'actuator', 'after', 'and', 'choice', 'const', 'controller', 'do', 'done', 'else', 'endless', 'entry', 'enum', 'environment', 'event', 'exit', 'extends', 'false', 'final', 'fitness', 'function', 'gives', 'history', 'import', 'initial', 'member', 'message', 'monitor', 'not', 'on', 'operation', 'optimize', 'or', 'package', 'parallel', 'preempted', 'region', 'self', 'send', 'sensor', 'service', 'state', 'statemachine', 'struct', 'succeeded', 'swarm', 'true', 'type', 'var', 'virtual', '{', '|', '}', '~', '\x7f'])
SET9 = frozenset(['choice', 'deep', 'final', 'history', 'initial', 'parallel', 'param', 'state', 'var'])
SET10 = frozenset(['!', '#', '$', '%', '&', "'", '(', ')', '*', '+', ',', '-', '.', '/', ':', ';', '<', '=', '>', '?', '@', '[', '\\', ']', '^', '`', 'aborted', 'action', 'actuator', 'after', 'and', 'behavior', 'choice', 'communication', 'connect', 'const', 'controller', 'do', 'done', 'else', 'endless', 'entry', 'enum', 'event', 'exit', 'extends', 'false', 'final', 'function', 'gives', 'history', 'import', 'in', 'initial', 'inout', 'member', 'message', 'monitor', 'not', 'on', 'operation', 'optimize', 'or', 'out', 'package', 'parallel', 'param', 'preempted', 'region', 'self', 'send', 'sensor', 'service', 'state', 'statemachine', 'struct', 'succeeded', 'swarm', 'true', 'type', 'var', 'virtual', '{', '|', '}', '~', '\x7f'])
SET11 = frozenset(['size', 'world'])
SET12 = frozenset(['in', 'maximize', 'minimize', 'param'])
SET13 = frozenset(['.', '/'])
SET14 = frozenset(['in', 'out'])
SET15 = frozenset(['[', 'after', 'choice', 'deep', 'do', 'entry', 'exit', 'final', 'history', 'initial', 'internal', 'monitor', 'on', 'parallel', 'state'])
SET16 = frozenset(['[', 'after', 'entry', 'exit', 'internal', 'monitor', 'on', 'region'])
SET17 = frozenset(['[', 'else'])
SET18 = frozenset(['after', 'monitor', 'on'])
SET19 = frozenset(['aborted', 'preempted', 'succeeded'])
SET20 = frozenset(['choice', 'deep', 'final', 'history', 'initial', 'parallel', 'state'])
SET21 = frozenset(['!', '#', '$', '%', '&', "'", ')', '*', '+', ',', '.', '/', ':', ';', '<', '=', '>', '?', '@', '[', '\\', ']', '^', '`', 'aborted', 'action', 'actuator', 'after', 'and', 'behavior', 'choice', 'communication', 'connect', 'const', 'controller', 'do', 'done', 'else', 'endless', 'entry', 'enum', 'environment', 'exit', 'extends', 'final', 'fitness', 'function', 'gives', 'history', 'import', 'in', 'initial', 'inout', 'member', 'message', 'monitor', 'on', 'operation', 'optimize', 'or', 'out', 'package', 'parallel', 'param', 'preempted', 'region', 'send', 'sensor', 'service', 'state', 'statemachine', 'struct', 'succeeded', 'swarm', 'type', 'var', 'virtual', '{', '|', '}', '~', '\x7f'])
RESERVED = frozenset(['aborted', 'action', 'actuator', 'after', 'and', 'behavior', 'choice', 'communication', 'connect', 'const', 'controller', 'do', 'done', 'else', 'endless', 'entry', 'enum', 'environment', 'event', 'exit', 'extends', 'false', 'final', 'fitness', 'function', 'gives', 'history', 'import', 'in', 'initial', 'inout', 'member', 'message', 'monitor', 'not', 'on', 'operation', 'optimize', 'or', 'out', 'package', 'parallel', 'param', 'preempted', 'region', 'self', 'send', 'sensor', 'service', 'state', 'statemachine', 'struct', 'succeeded', 'swarm', 'true', 'type', 'var', 'virtual'])
TERMINALS = (
    ('\\Z', 'EOF', ''),
    (';', '', ';'),
    ('package\\b', '', 'package'),
    ('optimize\\b', '', 'optimize'),
    ('\\{', '', '{'),
    ('\\}', '', '}'),
    ('import\\b', '', 'import'),
    ('ros\\b', '', 'ros'),
    ('struct\\b', '', 'struct'),
    (',', '', ','),
    ('enum\\b', '', 'enum'),
    (':', '', ':'),
    ('type\\b', '', 'type'),
    ('=', '', '='),
    ('const\\b', '', 'const'),
    ('message\\b', '', 'message'),
    ('service\\b', '', 'service'),
    ('request\\b', '', 'request'),
    ('response\\b', '', 'response'),
    ('action\\b', '', 'action'),
    ('goal\\b', '', 'goal'),
    ('result\\b', '', 'result'),
    ('feedback\\b', '', 'feedback'),
    ('swarm\\b', '', 'swarm'),
    ('event\\b', '', 'event'),
    ('on\\b', '', 'on'),
    ('function\\b', '', 'function'),
    ('extends\\b', '', 'extends'),
    ('member\\b', '', 'member'),
    ('endless\\b', '', 'endless'),
    ('statemachine\\b', '', 'statemachine'),
    ('environment\\b', '', 'environment'),
    ('fitness\\b', '', 'fitness'),
    ('(?:\\.[A-Za-z_][A-Za-z0-9_]*\\b)*', '', ''),
    ('(?:\\.[A-Za-z_][A-Za-z0-9_]*\\b)*(?:\\.\\*)?', '', ''),
    ('abstraction\\b', '', 'abstraction'),
    ('sensor\\b', '', 'sensor'),
    ('actuator\\b', '', 'actuator'),
    ('controller\\b', '', 'controller'),
    ('virtual\\b', '', 'virtual'),
    ('(?!(?:aborted|action|actuator|after|and|behavior|choice|communication|connect|const|controller|do|done|else|endless|entry|enum|environment|event|exit|extends|false|final|fitness|function|gives|history|import|in|initial|inout|member|message|monitor|not|on|operation|optimize|or|out|package|parallel|param|preempted|region|self|send|sensor|service|state|statemachine|struct|succeeded|swarm|true|type|var|virtual)\\b)[A-Za-z_][A-Za-z0-9_]*\\b', 'IDENT', ''),
    ('count\\b', '', 'count'),
    ('of\\b', '', 'of'),
    ('in\\b', '', 'in'),
    ('\\.\\.', '', '..'),
    ('\\.', '', '.'),
    ('step\\b', '', 'step'),
    ('"(?:[^"\\\\\\n]|\\\\[^\\n])*"', 'QUOTED', ''),
    ('(?:[.\\/][A-Za-z_][A-Za-z0-9_]*\\b)*', '', ''),
    ('<=?\\s*-?\\d+\\b', 'STRINGBOUND', ''),
    ('(?:\\[\\s*(?:<=?\\s*)?(?:-?\\d[\\d.]*|\\*)?\\s*\\])+', 'ARRAY', ''),
    ('-?\\d+\\b(?!\\.\\d)', 'INTEGER', ''),
    ('(?:\\/[A-Za-z_][A-Za-z0-9_]*\\b)?', '', ''),
    ('param\\b', '', 'param'),
    ('operation\\b', '', 'operation'),
    ('\\(', '', '('),
    ('\\)', '', ')'),
    ('behavior\\b', '', 'behavior'),
    ('communication\\b', '', 'communication'),
    ('connect\\b', '', 'connect'),
    ('\\->', '', '->'),
    ('var\\b', '', 'var'),
    ('initial\\b', '', 'initial'),
    ('\\[', '', '['),
    ('\\]', '', ']'),
    ('world\\b', '', 'world'),
    ('size\\b', '', 'size'),
    ('x\\b', '', 'x'),
    ('steps\\b', '', 'steps'),
    ('evaluations\\b', '', 'evaluations'),
    ('seed\\b', '', 'seed'),
    ('[A-Za-z_][A-Za-z0-9_]*\\b', 'WORD', ''),
    ('and\\b', '', 'and'),
    ('or\\b', '', 'or'),
    ('==', '', '=='),
    ('!=', '', '!='),
    ('<=', '', '<='),
    ('>=', '', '>='),
    ('<', '', '<'),
    ('>', '', '>'),
    ('\\+', '', '+'),
    ('\\*', '', '*'),
    ('/', '', '/'),
    ('%', '', '%'),
    ('out\\b', '', 'out'),
    ('inout\\b', '', 'inout'),
    ('state\\b', '', 'state'),
    ('parallel\\b', '', 'parallel'),
    ('choice\\b', '', 'choice'),
    ('deep\\b', '', 'deep'),
    ('history\\b', '', 'history'),
    ('final\\b', '', 'final'),
    ('\\d+\\b', 'INDEX', ''),
    ('\\d+(?:\\.\\d+)?[ \\t]*(?:km|cm|mm|m)\\b', 'LENGTH', ''),
    ('maximize\\b', '', 'maximize'),
    ('minimize\\b', '', 'minimize'),
    ('not\\b', '', 'not'),
    ('true\\b', '', 'true'),
    ('false\\b', '', 'false'),
    ('-(?!>)', 'MINUS', ''),
    ('else\\b', '', 'else'),
    ('\\d+\\b|\\*', 'BOUND', ''),
    ('\\d+(?:\\.\\d+)?(?:[eE][+-]?\\d+)?(?:[ \\t]*(?:us|ms|s|min|h))?\\b(?!\\.\\d)', 'QUANTITY', ''),
    ('[A-Za-z_][A-Za-z0-9_]*\\b(?=[ \\t]*(?:->|[:;}\\r\\n]|\\/[\\/*]|$))', 'PORTWORD', ''),
    ('do\\b', '', 'do'),
    ('by\\b', '', 'by'),
    ('gives\\b', '', 'gives'),
    ('entry\\b', '', 'entry'),
    ('exit\\b', '', 'exit'),
    ('internal\\b', '', 'internal'),
    ('region\\b', '', 'region'),
    ('self\\b', '', 'self'),
    ('=>', '', '=>'),
    ('after\\b', '', 'after'),
    ('monitor\\b', '', 'monitor'),
    ('as\\b', '', 'as'),
    ('send\\b', '', 'send'),
    ('to\\b', '', 'to'),
    ('done\\b', '', 'done'),
    ('succeeded\\b', '', 'succeeded'),
    ('aborted\\b', '', 'aborted'),
    ('preempted\\b', '', 'preempted'),
    ('(?<=[A-Za-z0-9_])(?=\\[)', '', ''),
)
PROGRAM = (
    (3, 3),
    (0, 0),
    (5, 0),
    (1, 9),
    (3, 28),
    (1, 8),
    (0, 1),
    (2, 8),
    (2, 9),
    (1, 15),
    (3, 31),
    (1, 14),
    (0, 1),
    (2, 14),
    (2, 9),
    (1, 27),
    (1, 22),
    (3, 39),
    (1, 21),
    (0, 1),
    (2, 21),
    (2, 26),
    (3, 83),
    (1, 26),
    (0, 1),
    (2, 26),
    (2, 15),
    (4, 0),
    (0, 2),
    (3, 94),
    (4, 0),
    (1, 34),
    (3, 96),
    (2, 38),
    (1, 37),
    (3, 100),
    (2, 38),
    (3, 103),
    (4, 0),
    (1, 42),
    (3, 106),
    (2, 82),
    (1, 45),
    (3, 120),
    (2, 82),
    (1, 48),
    (3, 138),
    (2, 82),
    (1, 51),
    (3, 143),
    (2, 82),
    (1, 54),
    (3, 150),
    (2, 82),
    (1, 57),
    (3, 173),
    (2, 82),
    (1, 60),
    (3, 212),
    (2, 82),
    (1, 63),
    (3, 268),
    (2, 82),
    (1, 66),
    (3, 280),
    (2, 82),
    (1, 69),
    (3, 293),
    (2, 82),
    (1, 72),
    (3, 308),
    (2, 82),
    (1, 75),
    (3, 323),
    (2, 82),
    (1, 78),
    (3, 337),
    (2, 82),
    (1, 81),
    (3, 348),
    (2, 82),
    (3, 359),
    (4, 0),
    (0, 3),
    (3, 370),
    (0, 4),
    (1, 92),
    (3, 373),
    (1, 91),
    (0, 1),
    (2, 91),
    (2, 86),
    (0, 5),
    (4, 0),
    (3, 370),
    (4, 0),
    (0, 6),
    (0, 7),
    (3, 381),
    (4, 0),
    (0, 6),
    (3, 381),
    (4, 0),
    (0, 6),
    (3, 383),
    (4, 0),
    (0, 8),
    (3, 386),
    (0, 4),
    (1, 118),
    (3, 388),
    (1, 117),
    (1, 115),
    (0, 9),
    (2, 116),
    (0, 1),
    (2, 117),
    (2, 109),
    (0, 5),
    (4, 0),
    (0, 10),
    (3, 386),
    (1, 126),
    (0, 11),
    (3, 392),
    (2, 126),
    (0, 4),
    (1, 136),
    (3, 400),
    (1, 135),
    (1, 133),
    (0, 9),
    (2, 134),
    (0, 1),
    (2, 135),
    (2, 127),
    (0, 5),
    (4, 0),
    (0, 12),
    (3, 386),
    (0, 13),
    (3, 392),
    (4, 0),
    (0, 14),
    (3, 386),
    (0, 11),
    (3, 392),
    (0, 13),
    (3, 406),
    (4, 0),
    (0, 15),
    (3, 408),
    (0, 4),
    (1, 171),
    (1, 160),
    (3, 143),
    (1, 159),
    (3, 143),
    (2, 156),
    (2, 164),
    (3, 388),
    (1, 164),
    (3, 388),
    (2, 161),
    (1, 170),
    (1, 168),
    (0, 9),
    (2, 169),
    (0, 1),
    (2, 170),
    (2, 153),
    (0, 5),
    (4, 0),
    (0, 16),
    (3, 408),
    (0, 4),
    (1, 193),
    (0, 17),
    (0, 4),
    (1, 188),
    (3, 388),
    (1, 187),
    (1, 185),
    (0, 9),
    (2, 186),
    (0, 1),
    (2, 187),
    (2, 179),
    (0, 5),
    (1, 192),
    (0, 1),
    (2, 192),
    (2, 193),
    (1, 210),
    (0, 18),
    (0, 4),
    (1, 205),
    (3, 388),
    (1, 204),
    (1, 202),
    (0, 9),
    (2, 203),
    (0, 1),
    (2, 204),
    (2, 196),
    (0, 5),
    (1, 209),
    (0, 1),
    (2, 209),
    (2, 210),
    (0, 5),
    (4, 0),
    (0, 19),
    (3, 408),
    (0, 4),
    (1, 232),
    (0, 20),
    (0, 4),
    (1, 227),
    (3, 388),
    (1, 226),
    (1, 224),
    (0, 9),
    (2, 225),
    (0, 1),
    (2, 226),
    (2, 218),
    (0, 5),
    (1, 231),
    (0, 1),
    (2, 231),
    (2, 232),
    (1, 249),
    (0, 21),
    (0, 4),
    (1, 244),
    (3, 388),
    (1, 243),
    (1, 241),
    (0, 9),
    (2, 242),
    (0, 1),
    (2, 243),
    (2, 235),
    (0, 5),
    (1, 248),
    (0, 1),
    (2, 248),
    (2, 249),
    (1, 266),
    (0, 22),
    (0, 4),
    (1, 261),
    (3, 388),
    (1, 260),
    (1, 258),
    (0, 9),
    (2, 259),
    (0, 1),
    (2, 260),
    (2, 252),
    (0, 5),
    (1, 265),
    (0, 1),
    (2, 265),
    (2, 266),
    (0, 5),
    (4, 0),
    (1, 271),
    (0, 23),
    (2, 271),
    (0, 24),
    (3, 386),
    (0, 11),
    (3, 392),
    (1, 279),
    (0, 25),
    (3, 381),
    (2, 279),
    (4, 0),
    (0, 26),
    (3, 386),
    (0, 11),
    (3, 410),
    (0, 4),
    (1, 291),
    (3, 415),
    (1, 290),
    (0, 1),
    (2, 290),
    (2, 285),
    (0, 5),
    (4, 0),
    (3, 423),
    (3, 386),
    (1, 299),
    (0, 27),
    (3, 370),
    (2, 299),
    (0, 4),
    (1, 306),
    (3, 434),
    (1, 305),
    (0, 1),
    (2, 305),
    (2, 300),
    (0, 5),
    (4, 0),
    (0, 28),
    (3, 386),
    (1, 314),
    (0, 27),
    (3, 370),
    (2, 314),
    (0, 4),
    (1, 321),
    (3, 445),
    (1, 320),
    (0, 1),
    (2, 320),
    (2, 315),
    (0, 5),
    (4, 0),
    (1, 326),
    (0, 29),
    (2, 326),
    (0, 30),
    (3, 386),
    (0, 4),
    (1, 335),
    (3, 462),
    (1, 334),
    (0, 1),
    (2, 334),
    (2, 329),
    (0, 5),
    (4, 0),
    (0, 23),
    (3, 386),
    (0, 4),
    (1, 346),
    (3, 473),
    (1, 345),
    (0, 1),
    (2, 345),
    (2, 340),
    (0, 5),
    (4, 0),
    (0, 31),
    (3, 386),
    (0, 4),
    (1, 357),
    (3, 484),
    (1, 356),
    (0, 1),
    (2, 356),
    (2, 351),
    (0, 5),
    (4, 0),
    (0, 32),
    (3, 386),
    (0, 4),
    (1, 368),
    (3, 489),
    (1, 367),
    (0, 1),
    (2, 367),
    (2, 362),
    (0, 5),
    (4, 0),
    (3, 497),
    (0, 33),
    (4, 0),
    (1, 376),
    (3, 499),
    (2, 380),
    (1, 379),
    (3, 502),
    (2, 380),
    (3, 510),
    (4, 0),
    (3, 522),
    (4, 0),
    (3, 497),
    (0, 34),
    (4, 0),
    (3, 497),
    (4, 0),
    (3, 524),
    (0, 11),
    (3, 392),
    (4, 0),
    (3, 526),
    (1, 396),
    (3, 529),
    (2, 396),
    (1, 399),
    (3, 531),
    (2, 399),
    (4, 0),
    (3, 386),
    (1, 405),
    (0, 13),
    (3, 533),
    (2, 405),
    (4, 0),
    (3, 535),
    (4, 0),
    (3, 541),
    (4, 0),
    (1, 413),
    (0, 35),
    (2, 414),
    (0, 23),
    (4, 0),
    (1, 418),
    (3, 544),
    (2, 422),
    (1, 421),
    (3, 549),
    (2, 422),
    (3, 554),
    (4, 0),
    (1, 426),
    (0, 36),
    (2, 433),
    (1, 429),
    (0, 37),
    (2, 433),
    (1, 432),
    (0, 38),
    (2, 433),
    (0, 39),
    (4, 0),
    (1, 437),
    (3, 563),
    (2, 444),
    (1, 440),
    (3, 554),
    (2, 444),
    (1, 443),
    (3, 572),
    (2, 444),
    (3, 584),
    (4, 0),
    (1, 448),
    (3, 584),
    (2, 461),
    (1, 451),
    (3, 587),
    (2, 461),
    (1, 454),
    (3, 563),
    (2, 461),
    (1, 457),
    (3, 554),
    (2, 461),
    (1, 460),
    (3, 601),
    (2, 461),
    (3, 606),
    (4, 0),
    (1, 465),
    (3, 554),
    (2, 472),
    (1, 468),
    (3, 623),
    (2, 472),
    (1, 471),
    (3, 632),
    (2, 472),
    (3, 635),
    (4, 0),
    (1, 476),
    (3, 649),
    (2, 483),
    (1, 479),
    (3, 652),
    (2, 483),
    (1, 482),
    (3, 655),
    (2, 483),
    (3, 677),
    (4, 0),
    (1, 487),
    (3, 693),
    (2, 488),
    (3, 696),
    (4, 0),
    (1, 492),
    (3, 705),
    (2, 496),
    (1, 495),
    (3, 554),
    (2, 496),
    (3, 710),
    (4, 0),
    (0, 40),
    (4, 0),
    (3, 713),
    (3, 406),
    (4, 0),
    (0, 41),
    (0, 42),
    (3, 497),
    (0, 43),
    (3, 406),
    (0, 44),
    (3, 406),
    (4, 0),
    (3, 497),
    (0, 45),
    (3, 497),
    (0, 43),
    (3, 406),
    (0, 44),
    (3, 406),
    (1, 521),
    (0, 46),
    (3, 406),
    (2, 521),
    (4, 0),
    (0, 47),
    (4, 0),
    (3, 721),
    (4, 0),
    (3, 497),
    (0, 48),
    (4, 0),
    (0, 49),
    (4, 0),
    (0, 50),
    (4, 0),
    (0, 51),
    (4, 0),
    (3, 723),
    (1, 540),
    (3, 728),
    (3, 723),
    (2, 536),
    (4, 0),
    (3, 497),
    (0, 52),
    (4, 0),
    (3, 766),
    (3, 381),
    (0, 11),
    (3, 392),
    (4, 0),
    (3, 771),
    (3, 381),
    (0, 11),
    (3, 392),
    (4, 0),
    (0, 53),
    (3, 386),
    (0, 11),
    (3, 392),
    (1, 562),
    (0, 13),
    (3, 406),
    (2, 562),
    (4, 0),
    (3, 776),
    (3, 784),
    (0, 11),
    (3, 392),
    (1, 571),
    (0, 25),
    (3, 381),
    (2, 571),
    (4, 0),
    (0, 54),
    (3, 386),
    (0, 55),
    (1, 582),
    (3, 786),
    (1, 581),
    (0, 9),
    (3, 786),
    (2, 577),
    (2, 582),
    (0, 56),
    (4, 0),
    (0, 57),
    (3, 370),
    (4, 0),
    (0, 58),
    (3, 386),
    (0, 4),
    (1, 599),
    (3, 794),
    (1, 598),
    (1, 596),
    (0, 9),
    (2, 597),
    (0, 1),
    (2, 598),
    (2, 590),
    (0, 5),
    (4, 0),
    (0, 59),
    (3, 798),
    (0, 60),
    (3, 798),
    (4, 0),
    (3, 386),
    (0, 11),
    (3, 370),
    (1, 622),
    (0, 4),
    (1, 620),
    (3, 794),
    (1, 619),
    (1, 617),
    (0, 9),
    (2, 618),
    (0, 1),
    (2, 619),
    (2, 611),
    (0, 5),
    (2, 622),
    (4, 0),
    (0, 61),
    (3, 386),
    (0, 11),
    (3, 392),
    (1, 631),
    (0, 13),
    (3, 406),
    (2, 631),
    (4, 0),
    (0, 62),
    (3, 370),
    (4, 0),
    (1, 638),
    (3, 804),
    (2, 648),
    (1, 641),
    (3, 832),
    (2, 648),
    (1, 644),
    (3, 844),
    (2, 648),
    (1, 647),
    (3, 855),
    (2, 648),
    (3, 865),
    (4, 0),
    (0, 31),
    (3, 370),
    (4, 0),
    (0, 32),
    (3, 370),
    (4, 0),
    (3, 386),
    (0, 11),
    (3, 370),
    (1, 663),
    (0, 63),
    (3, 868),
    (0, 64),
    (2, 663),
    (1, 676),
    (0, 4),
    (1, 674),
    (3, 794),
    (1, 673),
    (1, 671),
    (0, 9),
    (2, 672),
    (0, 1),
    (2, 673),
    (2, 665),
    (0, 5),
    (2, 676),
    (4, 0),
    (3, 497),
    (0, 63),
    (3, 874),
    (0, 64),
    (0, 4),
    (1, 691),
    (3, 794),
    (1, 690),
    (1, 688),
    (0, 9),
    (2, 689),
    (0, 1),
    (2, 690),
    (2, 682),
    (0, 5),
    (4, 0),
    (0, 65),
    (3, 381),
    (4, 0),
    (0, 66),
    (3, 876),
    (0, 67),
    (3, 876),
    (1, 704),
    (0, 67),
    (3, 876),
    (2, 704),
    (4, 0),
    (0, 43),
    (3, 386),
    (0, 11),
    (3, 392),
    (4, 0),
    (3, 878),
    (3, 406),
    (4, 0),
    (1, 716),
    (0, 68),
    (2, 720),
    (1, 719),
    (0, 69),
    (2, 720),
    (0, 70),
    (4, 0),
    (0, 71),
    (4, 0),
    (1, 726),
    (3, 883),
    (2, 723),
    (3, 888),
    (4, 0),
    (1, 731),
    (0, 72),
    (2, 765),
    (1, 734),
    (0, 73),
    (2, 765),
    (1, 737),
    (0, 74),
    (2, 765),
    (1, 740),
    (0, 75),
    (2, 765),
    (1, 743),
    (0, 76),
    (2, 765),
    (1, 746),
    (0, 77),
    (2, 765),
    (1, 749),
    (0, 78),
    (2, 765),
    (1, 752),
    (0, 79),
    (2, 765),
    (1, 755),
    (0, 80),
    (2, 765),
    (1, 758),
    (3, 910),
    (2, 765),
    (1, 761),
    (0, 81),
    (2, 765),
    (1, 764),
    (0, 82),
    (2, 765),
    (0, 83),
    (4, 0),
    (1, 769),
    (0, 19),
    (2, 770),
    (0, 16),
    (4, 0),
    (1, 774),
    (0, 43),
    (2, 775),
    (0, 84),
    (4, 0),
    (1, 779),
    (0, 85),
    (2, 783),
    (1, 782),
    (0, 43),
    (2, 783),
    (0, 84),
    (4, 0),
    (3, 912),
    (4, 0),
    (1, 790),
    (3, 771),
    (3, 524),
    (2, 791),
    (3, 524),
    (0, 11),
    (3, 392),
    (4, 0),
    (3, 524),
    (0, 13),
    (3, 406),
    (4, 0),
    (1, 802),
    (3, 497),
    (0, 45),
    (2, 802),
    (3, 912),
    (4, 0),
    (0, 86),
    (3, 386),
    (1, 821),
    (0, 13),
    (3, 370),
    (1, 820),
    (0, 55),
    (1, 818),
    (3, 917),
    (1, 817),
    (0, 9),
    (3, 917),
    (2, 813),
    (2, 818),
    (0, 56),
    (2, 820),
    (2, 821),
    (1, 831),
    (0, 4),
    (1, 829),
    (3, 921),
    (1, 828),
    (0, 1),
    (2, 828),
    (2, 823),
    (0, 5),
    (2, 831),
    (4, 0),
    (0, 87),
    (0, 86),
    (3, 386),
    (0, 4),
    (1, 842),
    (3, 938),
    (1, 841),
    (0, 1),
    (2, 841),
    (2, 836),
    (0, 5),
    (4, 0),
    (0, 88),
    (3, 386),
    (0, 4),
    (1, 853),
    (3, 949),
    (1, 852),
    (0, 1),
    (2, 852),
    (2, 847),
    (0, 5),
    (4, 0),
    (1, 858),
    (0, 89),
    (2, 858),
    (0, 90),
    (3, 386),
    (1, 864),
    (0, 60),
    (3, 370),
    (2, 864),
    (4, 0),
    (0, 91),
    (3, 386),
    (4, 0),
    (3, 966),
    (1, 873),
    (0, 44),
    (3, 966),
    (2, 873),
    (4, 0),
    (0, 92),
    (4, 0),
    (0, 93),
    (4, 0),
    (1, 881),
    (0, 94),
    (2, 882),
    (0, 95),
    (4, 0),
    (1, 886),
    (0, 96),
    (2, 887),
    (3, 910),
    (4, 0),
    (1, 891),
    (3, 968),
    (2, 909),
    (1, 894),
    (3, 522),
    (2, 909),
    (1, 897),
    (0, 97),
    (2, 909),
    (1, 900),
    (0, 98),
    (2, 909),
    (1, 903),
    (3, 970),
    (2, 909),
    (1, 906),
    (3, 981),
    (2, 909),
    (0, 55),
    (3, 535),
    (0, 56),
    (4, 0),
    (0, 99),
    (4, 0),
    (1, 915),
    (3, 497),
    (2, 916),
    (3, 987),
    (4, 0),
    (3, 524),
    (0, 13),
    (3, 406),
    (4, 0),
    (1, 924),
    (3, 989),
    (2, 937),
    (1, 927),
    (3, 1021),
    (2, 937),
    (1, 930),
    (3, 1029),
    (2, 937),
    (1, 933),
    (3, 1037),
    (2, 937),
    (1, 936),
    (3, 632),
    (2, 937),
    (3, 635),
    (4, 0),
    (1, 941),
    (3, 1103),
    (2, 948),
    (1, 944),
    (3, 1021),
    (2, 948),
    (1, 947),
    (3, 1029),
    (2, 948),
    (3, 1037),
    (4, 0),
    (1, 954),
    (0, 63),
    (3, 406),
    (0, 64),
    (2, 955),
    (0, 100),
    (1, 963),
    (0, 82),
    (3, 1114),
    (1, 962),
    (0, 9),
    (3, 1114),
    (2, 958),
    (2, 963),
    (0, 60),
    (3, 370),
    (4, 0),
    (0, 101),
    (4, 0),
    (0, 102),
    (4, 0),
    (3, 497),
    (0, 55),
    (1, 979),
    (3, 535),
    (1, 978),
    (0, 9),
    (3, 535),
    (2, 974),
    (2, 979),
    (0, 56),
    (4, 0),
    (3, 1119),
    (1, 986),
    (0, 45),
    (3, 721),
    (2, 982),
    (4, 0),
    (0, 103),
    (4, 0),
    (0, 104),
    (3, 370),
    (1, 1006),
    (0, 55),
    (1, 997),
    (0, 105),
    (3, 386),
    (2, 1004),
    (1, 1004),
    (3, 917),
    (1, 1003),
    (0, 9),
    (3, 917),
    (2, 999),
    (2, 1004),
    (0, 56),
    (2, 1006),
    (1, 1020),
    (0, 106),
    (1, 1012),
    (0, 105),
    (3, 386),
    (2, 1019),
    (0, 55),
    (3, 1127),
    (1, 1018),
    (0, 9),
    (3, 1127),
    (2, 1014),
    (0, 56),
    (2, 1020),
    (4, 0),
    (0, 107),
    (0, 82),
    (3, 1114),
    (1, 1028),
    (0, 9),
    (3, 1114),
    (2, 1024),
    (4, 0),
    (0, 108),
    (0, 82),
    (3, 1114),
    (1, 1036),
    (0, 9),
    (3, 1114),
    (2, 1032),
    (4, 0),
    (1, 1040),
    (0, 109),
    (2, 1040),
    (1, 1081),
    (1, 1049),
    (0, 25),
    (3, 1131),
    (1, 1048),
    (0, 9),
    (3, 1131),
    (2, 1044),
    (2, 1061),
    (1, 1056),
    (3, 1139),
    (1, 1055),
    (0, 9),
    (3, 1139),
    (2, 1051),
    (2, 1061),
    (3, 1142),
    (1, 1061),
    (0, 9),
    (3, 1142),
    (2, 1057),
    (1, 1066),
    (0, 63),
    (3, 406),
    (0, 64),
    (2, 1066),
    (1, 1078),
    (0, 82),
    (3, 1114),
    (1, 1073),
    (0, 9),
    (3, 1114),
    (2, 1069),
    (1, 1077),
    (0, 60),
    (3, 370),
    (2, 1077),
    (2, 1080),
    (0, 60),
    (3, 370),
    (2, 1102),
    (1, 1089),
    (0, 25),
    (3, 1151),
    (1, 1088),
    (0, 9),
    (3, 1151),
    (2, 1084),
    (2, 1102),
    (0, 63),
    (3, 406),
    (0, 64),
    (1, 1100),
    (0, 82),
    (3, 1114),
    (1, 1099),
    (0, 9),
    (3, 1114),
    (2, 1095),
    (2, 1100),
    (0, 60),
    (3, 370),
    (4, 0),
    (0, 110),
    (3, 386),
    (0, 4),
    (1, 1112),
    (3, 1153),
    (1, 1111),
    (0, 1),
    (2, 1111),
    (2, 1106),
    (0, 5),
    (4, 0),
    (1, 1117),
    (3, 1158),
    (2, 1118),
    (3, 1176),
    (4, 0),
    (1, 1122),
    (0, 24),
    (2, 1126),
    (1, 1125),
    (0, 111),
    (2, 1126),
    (3, 497),
    (4, 0),
    (3, 524),
    (0, 112),
    (3, 1180),
    (4, 0),
    (1, 1134),
    (3, 1151),
    (2, 1138),
    (1, 1137),
    (3, 1182),
    (2, 1138),
    (3, 1192),
    (4, 0),
    (0, 113),
    (3, 1194),
    (4, 0),
    (0, 114),
    (3, 381),
    (0, 11),
    (3, 392),
    (1, 1150),
    (0, 115),
    (3, 386),
    (2, 1150),
    (4, 0),
    (3, 1196),
    (4, 0),
    (1, 1156),
    (3, 632),
    (2, 1157),
    (3, 635),
    (4, 0),
    (0, 116),
    (3, 370),
    (1, 1171),
    (0, 55),
    (1, 1169),
    (3, 917),
    (1, 1168),
    (0, 9),
    (3, 917),
    (2, 1164),
    (2, 1169),
    (0, 56),
    (2, 1171),
    (1, 1175),
    (0, 117),
    (3, 1204),
    (2, 1175),
    (4, 0),
    (3, 1180),
    (0, 13),
    (3, 406),
    (4, 0),
    (3, 723),
    (4, 0),
    (1, 1186),
    (3, 497),
    (0, 45),
    (2, 1186),
    (0, 118),
    (1, 1191),
    (0, 45),
    (3, 497),
    (2, 1191),
    (4, 0),
    (3, 370),
    (4, 0),
    (3, 1212),
    (4, 0),
    (1, 1199),
    (0, 119),
    (2, 1203),
    (1, 1202),
    (0, 120),
    (2, 1203),
    (0, 121),
    (4, 0),
    (1, 1210),
    (3, 1218),
    (0, 63),
    (3, 406),
    (0, 64),
    (2, 1211),
    (3, 406),
    (4, 0),
    (3, 723),
    (1, 1217),
    (3, 1220),
    (3, 723),
    (2, 1213),
    (4, 0),
    (3, 1228),
    (4, 0),
    (1, 1223),
    (0, 80),
    (2, 1227),
    (1, 1226),
    (3, 910),
    (2, 1227),
    (0, 81),
    (4, 0),
    (3, 497),
    (0, 122),
    (4, 0),
)


def parse(source: Source, docs: dict[int, str], limit: int) -> tuple[Model, int] | None:
    """Parse a file to a model; None where it does not follow the grammar.

    With the model comes the number of wrong expressions, which have no trees. Documentation is
    taken from `docs`, which maps places to texts. Raises TooDeepError for nesting beyond `limit`.
    """
    text = source.text
    depth = at = 0
    tokens, ends = LEXER.tokenize(text)
    token = tokens[0]
    find = text.find
    inline = {}
    expressions = ExpressionParser(LANGUAGE, source, (tokens, ends), limit)
    expression = expressions.expression
    operand = expressions.operand
    delay = expressions.delay

    def r_Model():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        package_ = None
        imports_ = []
        declarations_ = []
        optimizations_ = []
        if token == 'package':
            before1 = at
            before2 = package_
            while True:
                value = r_Package()
                if value is None: at = before1; token = tokens[at]; package_ = before2; break
                package_ = value
                if token == ';':
                    at += 1; token = tokens[at]
                break
        while token == 'import':
            before3 = at
            before4 = len(imports_)
            rule = Import_RULES.get(token)
            if rule is None: at = before3; token = tokens[at]; del imports_[before4:]; break
            value = rule()
            if value is None: at = before3; token = tokens[at]; del imports_[before4:]; break
            imports_.append(value)
            if token == ';':
                at += 1; token = tokens[at]
        while token in SET0:
            before5 = at
            before6 = len(declarations_)
            before7 = len(optimizations_)
            if token in SET1:
                rule = Declaration_RULES.get(token)
                if rule is None: at = before5; token = tokens[at]; del declarations_[before6:]; del optimizations_[before7:]; break
                value = rule()
                if value is None: at = before5; token = tokens[at]; del declarations_[before6:]; del optimizations_[before7:]; break
                declarations_.append(value)
                if token == ';':
                    at += 1; token = tokens[at]
            elif token == 'optimize':
                value = r_Optimization()
                if value is None: at = before5; token = tokens[at]; del declarations_[before6:]; del optimizations_[before7:]; break
                optimizations_.append(value)
                if token == ';':
                    at += 1; token = tokens[at]
            else: at = before5; token = tokens[at]; del declarations_[before6:]; del optimizations_[before7:]; break
        made = new_node(Model)
        made.span = new_span(Span, (source, start, ends[at]))
        made.package = package_
        made.imports = imports_
        made.declarations = declarations_
        made.optimizations = optimizations_
        made.missing_separators = ()
        return made

    def r_Package():
        nonlocal at, token
        start = ends[at + 1] - 7
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        at += 1; token = tokens[at]
        first = ends[at + 1] - len(token)
        if not (token >= 'A' and token not in SET2): return None
        taken2 = token; at += 1; token = tokens[at]
        text1 = taken2
        if token == '.':
            match3 = REGEX0(text, ends[at + 1] - len(token))
            if match3[0]:
                text1 += match3[0]
                end = match3.end()
                while ends[at] < end: at += 1
                if ends[at] > end: return None
                token = tokens[at]
        value = new_word(Word, text1)
        value.span = new_span(Span, (source, first, ends[at]))
        name_ = value
        made = new_node(Package)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_Optimization():
        nonlocal at, token
        start = ends[at + 1] - 8
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        swarm_ = None
        items_ = []
        at += 1; token = tokens[at]
        first = ends[at + 1] - len(token)
        if not (token >= 'A' and token not in SET2): return None
        taken2 = token; at += 1; token = tokens[at]
        text1 = taken2
        if token == '.':
            match3 = REGEX0(text, ends[at + 1] - len(token))
            if match3[0]:
                text1 += match3[0]
                end = match3.end()
                while ends[at] < end: at += 1
                if ends[at] > end: return None
                token = tokens[at]
        value = new_node(Ref)
        value.name = text1
        value.kind = 'Swarm'
        value.span = new_span(Span, (source, first, first + len(text1)))
        value.target = None
        swarm_ = value
        if not (token == '{'): return None
        at += 1; token = tokens[at]
        while token >= 'A' and token not in SET2:
            before4 = at
            before5 = len(items_)
            rule = OptimizationItem_RULES.get(token, r_ParamRange)
            value = rule()
            if value is None: at = before4; token = tokens[at]; del items_[before5:]; break
            items_.append(value)
            if token == ';':
                at += 1; token = tokens[at]
        if not (token == '}'): return None
        at += 1; token = tokens[at]
        made = new_node(Optimization)
        made.span = new_span(Span, (source, start, ends[at]))
        made.swarm = swarm_
        made.items = items_
        made.doc = docs.pop(start) if start in docs else ''
        made.by_class = None
        return made

    def r_ImportRos():
        nonlocal at, token
        start = ends[at + 1] - 6
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        path_ = None
        at += 1; token = tokens[at]
        if not (token == 'ros'): return None
        at += 1; token = tokens[at]
        first = ends[at + 1] - len(token)
        match1 = REGEX1(text, ends[at + 1] - len(token))
        if match1 is None: return None
        end = match1.end()
        while ends[at] < end: at += 1
        if ends[at] > end: return None
        token = tokens[at]
        value = new_word(Word, unquoted(match1[0]))
        value.span = new_span(Span, (source, first, ends[at]))
        path_ = value
        made = new_node(ImportRos)
        made.span = new_span(Span, (source, start, ends[at]))
        made.path = path_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_ImportFile():
        nonlocal at, token
        start = ends[at + 1] - 6
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        path_ = None
        at += 1; token = tokens[at]
        first = ends[at + 1] - len(token)
        match1 = REGEX1(text, ends[at + 1] - len(token))
        if match1 is None: return None
        end = match1.end()
        while ends[at] < end: at += 1
        if ends[at] > end: return None
        token = tokens[at]
        value = new_word(Word, unquoted(match1[0]))
        value.span = new_span(Span, (source, first, ends[at]))
        path_ = value
        made = new_node(ImportFile)
        made.span = new_span(Span, (source, start, ends[at]))
        made.path = path_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_ImportLibrary():
        nonlocal at, token
        start = ends[at + 1] - 6
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): return None
        taken2 = token; at += 1; token = tokens[at]
        text1 = taken2
        if token == '.':
            match3 = REGEX2(text, ends[at + 1] - len(token))
            if match3[0]:
                text1 += match3[0]
                end = match3.end()
                while ends[at] < end: at += 1
                if ends[at] > end: return None
                token = tokens[at]
        name_ = text1
        made = new_node(ImportLibrary)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_StructType():
        nonlocal at, token
        start = ends[at + 1] - 6
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        fields_ = []
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if not (token == '{'): return None
        at += 1; token = tokens[at]
        while token >= 'A' and token not in SET3:
            before2 = at
            before3 = len(fields_)
            value = r_Field()
            if value is None: at = before2; token = tokens[at]; del fields_[before3:]; break
            fields_.append(value)
            if token in SET4:
                at += 1; token = tokens[at]
        if not (token == '}'): return None
        at += 1; token = tokens[at]
        made = new_node(StructType)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.fields = fields_
        made.doc = docs.pop(start) if start in docs else ''
        made.by_class = None
        return made

    def r_EnumType():
        nonlocal at, token
        start = ends[at + 1] - 4
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        underlying_ = None
        values_ = []
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if token == ':':
            before2 = at
            before3 = underlying_
            while True:
                at += 1; token = tokens[at]
                value = r_TypeRef()
                if value is None: at = before2; token = tokens[at]; underlying_ = before3; break
                underlying_ = value
                break
        if not (token == '{'): return None
        at += 1; token = tokens[at]
        while token >= 'A' and token not in SET2:
            before4 = at
            before5 = len(values_)
            value = r_EnumValue()
            if value is None: at = before4; token = tokens[at]; del values_[before5:]; break
            values_.append(value)
            if token in SET4:
                at += 1; token = tokens[at]
        if not (token == '}'): return None
        at += 1; token = tokens[at]
        made = new_node(EnumType)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.underlying = underlying_
        made.values = values_
        made.doc = docs.pop(start) if start in docs else ''
        made.by_class = None
        made.type = None
        return made

    def r_AliasType():
        nonlocal at, token
        start = ends[at + 1] - 4
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        type_ = None
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if not (token == '='): return None
        at += 1; token = tokens[at]
        value = r_TypeRef()
        if value is None: return None
        type_ = value
        made = new_node(AliasType)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.type = type_
        made.doc = docs.pop(start) if start in docs else ''
        made.by_class = None
        return made

    def r_Constant():
        nonlocal at, token
        start = ends[at + 1] - 5
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        type_ = None
        value_ = None
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if not (token == ':'): return None
        at += 1; token = tokens[at]
        value = r_TypeRef()
        if value is None: return None
        type_ = value
        if not (token == '='): return None
        at += 1; token = tokens[at]
        found = expression(at)
        if found is None: return None
        value, at = found; token = tokens[at]
        value_ = value
        made = new_node(Constant)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.type = type_
        made.value = value_
        made.doc = docs.pop(start) if start in docs else ''
        made.by_class = None
        return made

    def r_MessageType():
        nonlocal at, token
        start = ends[at + 1] - 7
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        constants_ = []
        fields_ = []
        at += 1; token = tokens[at]
        first = ends[at + 1] - len(token)
        if not (token >= 'A' and token not in SET2): return None
        taken2 = token; at += 1; token = tokens[at]
        text1 = taken2
        if token == '/':
            match3 = REGEX3(text, ends[at + 1] - len(token))
            if match3[0]:
                text1 += match3[0]
                end = match3.end()
                while ends[at] < end: at += 1
                if ends[at] > end: return None
                token = tokens[at]
        value = new_word(Word, text1)
        value.span = new_span(Span, (source, first, ends[at]))
        name_ = value
        if not (token == '{'): return None
        at += 1; token = tokens[at]
        while token >= 'A' and token not in SET3:
            before4 = at
            before5 = len(constants_)
            before6 = len(fields_)
            chosen7 = False
            if not chosen7 and token == 'const':
                before8 = at
                while True:
                    value = r_Constant()
                    if value is None: at = before8; token = tokens[at]; break
                    constants_.append(value)
                    while token == 'const':
                        before9 = at
                        value = r_Constant()
                        if value is None: at = before9; token = tokens[at]; break
                        constants_.append(value)
                    chosen7 = True
                    break
            if not chosen7 and token >= 'A' and token not in SET3:
                before10 = at
                while True:
                    value = r_Field()
                    if value is None: at = before10; token = tokens[at]; break
                    fields_.append(value)
                    while token >= 'A' and token not in SET3:
                        before11 = at
                        value = r_Field()
                        if value is None: at = before11; token = tokens[at]; break
                        fields_.append(value)
                    chosen7 = True
                    break
            if not chosen7: at = before4; token = tokens[at]; del constants_[before5:]; del fields_[before6:]; break
            if token in SET4:
                at += 1; token = tokens[at]
        if not (token == '}'): return None
        at += 1; token = tokens[at]
        made = new_node(MessageType)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.constants = constants_
        made.fields = fields_
        made.doc = docs.pop(start) if start in docs else ''
        made.by_class = None
        return made

    def r_ServiceType():
        nonlocal at, token
        start = ends[at + 1] - 7
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        request_ = []
        response_ = []
        at += 1; token = tokens[at]
        first = ends[at + 1] - len(token)
        if not (token >= 'A' and token not in SET2): return None
        taken2 = token; at += 1; token = tokens[at]
        text1 = taken2
        if token == '/':
            match3 = REGEX3(text, ends[at + 1] - len(token))
            if match3[0]:
                text1 += match3[0]
                end = match3.end()
                while ends[at] < end: at += 1
                if ends[at] > end: return None
                token = tokens[at]
        value = new_word(Word, text1)
        value.span = new_span(Span, (source, first, ends[at]))
        name_ = value
        if not (token == '{'): return None
        at += 1; token = tokens[at]
        if token == 'request':
            before4 = at
            before5 = len(request_)
            while True:
                at += 1; token = tokens[at]
                if not (token == '{'): at = before4; token = tokens[at]; del request_[before5:]; break
                at += 1; token = tokens[at]
                while token >= 'A' and token not in SET3:
                    before6 = at
                    before7 = len(request_)
                    value = r_Field()
                    if value is None: at = before6; token = tokens[at]; del request_[before7:]; break
                    request_.append(value)
                    if token in SET4:
                        at += 1; token = tokens[at]
                if not (token == '}'): at = before4; token = tokens[at]; del request_[before5:]; break
                at += 1; token = tokens[at]
                if token == ';':
                    at += 1; token = tokens[at]
                break
        if token == 'response':
            before8 = at
            before9 = len(response_)
            while True:
                at += 1; token = tokens[at]
                if not (token == '{'): at = before8; token = tokens[at]; del response_[before9:]; break
                at += 1; token = tokens[at]
                while token >= 'A' and token not in SET3:
                    before10 = at
                    before11 = len(response_)
                    value = r_Field()
                    if value is None: at = before10; token = tokens[at]; del response_[before11:]; break
                    response_.append(value)
                    if token in SET4:
                        at += 1; token = tokens[at]
                if not (token == '}'): at = before8; token = tokens[at]; del response_[before9:]; break
                at += 1; token = tokens[at]
                if token == ';':
                    at += 1; token = tokens[at]
                break
        if not (token == '}'): return None
        at += 1; token = tokens[at]
        made = new_node(ServiceType)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.request = request_
        made.response = response_
        made.doc = docs.pop(start) if start in docs else ''
        made.by_class = None
        return made

    def r_ActionType():
        nonlocal at, token
        start = ends[at + 1] - 6
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        goal_ = []
        result_ = []
        feedback_ = []
        at += 1; token = tokens[at]
        first = ends[at + 1] - len(token)
        if not (token >= 'A' and token not in SET2): return None
        taken2 = token; at += 1; token = tokens[at]
        text1 = taken2
        if token == '/':
            match3 = REGEX3(text, ends[at + 1] - len(token))
            if match3[0]:
                text1 += match3[0]
                end = match3.end()
                while ends[at] < end: at += 1
                if ends[at] > end: return None
                token = tokens[at]
        value = new_word(Word, text1)
        value.span = new_span(Span, (source, first, ends[at]))
        name_ = value
        if not (token == '{'): return None
        at += 1; token = tokens[at]
        if token == 'goal':
            before4 = at
            before5 = len(goal_)
            while True:
                at += 1; token = tokens[at]
                if not (token == '{'): at = before4; token = tokens[at]; del goal_[before5:]; break
                at += 1; token = tokens[at]
                while token >= 'A' and token not in SET3:
                    before6 = at
                    before7 = len(goal_)
                    value = r_Field()
                    if value is None: at = before6; token = tokens[at]; del goal_[before7:]; break
                    goal_.append(value)
                    if token in SET4:
                        at += 1; token = tokens[at]
                if not (token == '}'): at = before4; token = tokens[at]; del goal_[before5:]; break
                at += 1; token = tokens[at]
                if token == ';':
                    at += 1; token = tokens[at]
                break
        if token == 'result':
            before8 = at
            before9 = len(result_)
            while True:
                at += 1; token = tokens[at]
                if not (token == '{'): at = before8; token = tokens[at]; del result_[before9:]; break
                at += 1; token = tokens[at]
                while token >= 'A' and token not in SET3:
                    before10 = at
                    before11 = len(result_)
                    value = r_Field()
                    if value is None: at = before10; token = tokens[at]; del result_[before11:]; break
                    result_.append(value)
                    if token in SET4:
                        at += 1; token = tokens[at]
                if not (token == '}'): at = before8; token = tokens[at]; del result_[before9:]; break
                at += 1; token = tokens[at]
                if token == ';':
                    at += 1; token = tokens[at]
                break
        if token == 'feedback':
            before12 = at
            before13 = len(feedback_)
            while True:
                at += 1; token = tokens[at]
                if not (token == '{'): at = before12; token = tokens[at]; del feedback_[before13:]; break
                at += 1; token = tokens[at]
                while token >= 'A' and token not in SET3:
                    before14 = at
                    before15 = len(feedback_)
                    value = r_Field()
                    if value is None: at = before14; token = tokens[at]; del feedback_[before15:]; break
                    feedback_.append(value)
                    if token in SET4:
                        at += 1; token = tokens[at]
                if not (token == '}'): at = before12; token = tokens[at]; del feedback_[before13:]; break
                at += 1; token = tokens[at]
                if token == ';':
                    at += 1; token = tokens[at]
                break
        if not (token == '}'): return None
        at += 1; token = tokens[at]
        made = new_node(ActionType)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.goal = goal_
        made.result = result_
        made.feedback = feedback_
        made.doc = docs.pop(start) if start in docs else ''
        made.by_class = None
        return made

    def r_Event():
        nonlocal at, token
        start = ends[at + 1] - 5
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        swarm_ = False
        name_ = None
        type_ = None
        topic_ = None
        if token == 'swarm':
            at += 1; token = tokens[at]
            swarm_ = True
        if not (token == 'event'): return None
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if not (token == ':'): return None
        at += 1; token = tokens[at]
        value = r_TypeRef()
        if value is None: return None
        type_ = value
        if token == 'on':
            before2 = at
            before3 = topic_
            while True:
                at += 1; token = tokens[at]
                first = ends[at + 1] - len(token)
                match4 = REGEX1(text, ends[at + 1] - len(token))
                if match4 is None: at = before2; token = tokens[at]; topic_ = before3; break
                end = match4.end()
                while ends[at] < end: at += 1
                if ends[at] > end: at = before2; token = tokens[at]; topic_ = before3; break
                token = tokens[at]
                value = new_word(Word, unquoted(match4[0]))
                value.span = new_span(Span, (source, first, ends[at]))
                topic_ = value
                break
        made = new_node(Event)
        made.span = new_span(Span, (source, start, ends[at]))
        made.swarm = swarm_
        made.name = name_
        made.type = type_
        made.topic = topic_
        made.doc = docs.pop(start) if start in docs else ''
        made.by_class = None
        return made

    def r_Function():
        nonlocal at, token
        start = ends[at + 1] - 8
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        category_ = None
        items_ = []
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if not (token == ':'): return None
        at += 1; token = tokens[at]
        if not (token in SET5): return None
        taken2 = token; at += 1; token = tokens[at]
        category_ = taken2
        if not (token == '{'): return None
        at += 1; token = tokens[at]
        while token in SET6:
            before3 = at
            before4 = len(items_)
            rule = FunctionItem_RULES.get(token)
            if rule is None: at = before3; token = tokens[at]; del items_[before4:]; break
            value = rule()
            if value is None: at = before3; token = tokens[at]; del items_[before4:]; break
            items_.append(value)
            if token == ';':
                at += 1; token = tokens[at]
        if not (token == '}'): return None
        at += 1; token = tokens[at]
        made = new_node(Function)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.category = category_
        made.items = items_
        made.doc = docs.pop(start) if start in docs else ''
        made.by_class = None
        return made

    def r_Component():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        kind_ = None
        name_ = None
        base_ = None
        items_ = []
        taken1 = token; at += 1; token = tokens[at]
        kind_ = taken1
        if not (token >= 'A' and token not in SET2): return None
        taken2 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken2)
        value.span = new_span(Span, (source, ends[at] - len(taken2), ends[at]))
        name_ = value
        if token == 'extends':
            before3 = at
            before4 = base_
            while True:
                at += 1; token = tokens[at]
                first = ends[at + 1] - len(token)
                if not (token >= 'A' and token not in SET2): at = before3; token = tokens[at]; base_ = before4; break
                taken6 = token; at += 1; token = tokens[at]
                text5 = taken6
                if token == '.':
                    match7 = REGEX0(text, ends[at + 1] - len(token))
                    if match7[0]:
                        text5 += match7[0]
                        end = match7.end()
                        while ends[at] < end: at += 1
                        if ends[at] > end: at = before3; token = tokens[at]; base_ = before4; break
                        token = tokens[at]
                value = new_node(Ref)
                value.name = text5
                value.kind = 'Component'
                value.span = new_span(Span, (source, first, first + len(text5)))
                value.target = None
                base_ = value
                break
        if not (token == '{'): return None
        at += 1; token = tokens[at]
        while token in SET7:
            before8 = at
            before9 = len(items_)
            rule = ComponentItem_RULES.get(token)
            if rule is None: at = before8; token = tokens[at]; del items_[before9:]; break
            value = rule()
            if value is None: at = before8; token = tokens[at]; del items_[before9:]; break
            items_.append(value)
            if token == ';':
                at += 1; token = tokens[at]
        if not (token == '}'): return None
        at += 1; token = tokens[at]
        made = new_node(Component)
        made.span = new_span(Span, (source, start, ends[at]))
        made.kind = kind_
        made.name = name_
        made.base = base_
        made.items = items_
        made.doc = docs.pop(start) if start in docs else ''
        made.by_class = None
        return made

    def r_Member():
        nonlocal at, token
        start = ends[at + 1] - 6
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        base_ = None
        items_ = []
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if token == 'extends':
            before2 = at
            before3 = base_
            while True:
                at += 1; token = tokens[at]
                first = ends[at + 1] - len(token)
                if not (token >= 'A' and token not in SET2): at = before2; token = tokens[at]; base_ = before3; break
                taken5 = token; at += 1; token = tokens[at]
                text4 = taken5
                if token == '.':
                    match6 = REGEX0(text, ends[at + 1] - len(token))
                    if match6[0]:
                        text4 += match6[0]
                        end = match6.end()
                        while ends[at] < end: at += 1
                        if ends[at] > end: at = before2; token = tokens[at]; base_ = before3; break
                        token = tokens[at]
                value = new_node(Ref)
                value.name = text4
                value.kind = 'Member'
                value.span = new_span(Span, (source, first, first + len(text4)))
                value.target = None
                base_ = value
                break
        if not (token == '{'): return None
        at += 1; token = tokens[at]
        while token >= 'A' and token not in SET8:
            before7 = at
            before8 = len(items_)
            rule = MemberItem_RULES.get(token, r_Part)
            value = rule()
            if value is None: at = before7; token = tokens[at]; del items_[before8:]; break
            items_.append(value)
            if token == ';':
                at += 1; token = tokens[at]
        if not (token == '}'): return None
        at += 1; token = tokens[at]
        made = new_node(Member)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.base = base_
        made.items = items_
        made.doc = docs.pop(start) if start in docs else ''
        made.by_class = None
        return made

    def r_StateMachine():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        endless_ = False
        name_ = None
        items_ = []
        if token == 'endless':
            at += 1; token = tokens[at]
            endless_ = True
        if not (token == 'statemachine'): return None
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if not (token == '{'): return None
        at += 1; token = tokens[at]
        while token in SET9:
            before2 = at
            before3 = len(items_)
            rule = MachineItem_RULES.get(token)
            if rule is None: at = before2; token = tokens[at]; del items_[before3:]; break
            value = rule()
            if value is None: at = before2; token = tokens[at]; del items_[before3:]; break
            items_.append(value)
            if token == ';':
                at += 1; token = tokens[at]
        if not (token == '}'): return None
        at += 1; token = tokens[at]
        made = new_node(StateMachine)
        made.span = new_span(Span, (source, start, ends[at]))
        made.endless = endless_
        made.name = name_
        made.items = items_
        made.doc = docs.pop(start) if start in docs else ''
        made.by_class = None
        return made

    def r_Swarm():
        nonlocal at, token
        start = ends[at + 1] - 5
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        items_ = []
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if not (token == '{'): return None
        at += 1; token = tokens[at]
        while token >= 'A' and token not in SET10:
            before2 = at
            before3 = len(items_)
            rule = SwarmItem_RULES.get(token, try_Role_RobotValues)
            value = rule()
            if value is None: at = before2; token = tokens[at]; del items_[before3:]; break
            items_.append(value)
            if token == ';':
                at += 1; token = tokens[at]
        if not (token == '}'): return None
        at += 1; token = tokens[at]
        made = new_node(Swarm)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.items = items_
        made.doc = docs.pop(start) if start in docs else ''
        made.by_class = None
        return made

    def r_Environment():
        nonlocal at, token
        start = ends[at + 1] - 11
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        items_ = []
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if not (token == '{'): return None
        at += 1; token = tokens[at]
        while token in SET11:
            before2 = at
            before3 = len(items_)
            rule = EnvironmentItem_RULES.get(token)
            if rule is None: at = before2; token = tokens[at]; del items_[before3:]; break
            value = rule()
            if value is None: at = before2; token = tokens[at]; del items_[before3:]; break
            items_.append(value)
            if token == ';':
                at += 1; token = tokens[at]
        if not (token == '}'): return None
        at += 1; token = tokens[at]
        made = new_node(Environment)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.items = items_
        made.doc = docs.pop(start) if start in docs else ''
        made.by_class = None
        return made

    def r_Fitness():
        nonlocal at, token
        start = ends[at + 1] - 7
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        items_ = []
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if not (token == '{'): return None
        at += 1; token = tokens[at]
        while token in SET12:
            before2 = at
            before3 = len(items_)
            rule = FitnessItem_RULES.get(token)
            if rule is None: at = before2; token = tokens[at]; del items_[before3:]; break
            value = rule()
            if value is None: at = before2; token = tokens[at]; del items_[before3:]; break
            items_.append(value)
            if token == ';':
                at += 1; token = tokens[at]
        if not (token == '}'): return None
        at += 1; token = tokens[at]
        made = new_node(Fitness)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.items = items_
        made.doc = docs.pop(start) if start in docs else ''
        made.by_class = None
        return made

    def r_Field():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        if find('\n', ends[at], start) < 0: inline[at] = ','
        name_ = None
        type_ = None
        if not (token >= 'A' and token not in SET3): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if not (token == ':'): return None
        at += 1; token = tokens[at]
        value = r_TypeRef()
        if value is None: return None
        type_ = value
        made = new_node(Field)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.type = type_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_TypeRef():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        name_ = None
        bound_ = None
        array_ = None
        if not (token >= 'A' and token not in SET2): return None
        taken2 = token; at += 1; token = tokens[at]
        text1 = taken2
        if token in SET13:
            match3 = REGEX4(text, ends[at + 1] - len(token))
            if match3[0]:
                text1 += match3[0]
                end = match3.end()
                while ends[at] < end: at += 1
                if ends[at] > end: return None
                token = tokens[at]
        name_ = text1
        if token == '<':
            before4 = at
            while True:
                match5 = REGEX5(text, ends[at + 1] - len(token))
                if match5 is None: at = before4; token = tokens[at]; break
                end = match5.end()
                while ends[at] < end: at += 1
                if ends[at] > end: at = before4; token = tokens[at]; break
                token = tokens[at]
                bound_ = match5[0]
                break
        if token == '[':
            before6 = at
            while True:
                match7 = REGEX6(text, ends[at + 1] - len(token))
                if match7 is None: at = before6; token = tokens[at]; break
                end = match7.end()
                while ends[at] < end: at += 1
                if ends[at] > end: at = before6; token = tokens[at]; break
                token = tokens[at]
                array_ = match7[0]
                break
        made = new_node(TypeRef)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.bound = bound_
        made.array = array_
        made.type = None
        return made

    def r_EnumValue():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        if find('\n', ends[at], start) < 0: inline[at] = ','
        name_ = None
        value_ = None
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if token == '=':
            before2 = at
            before3 = value_
            while True:
                at += 1; token = tokens[at]
                match4 = REGEX7(text, ends[at + 1] - len(token))
                if match4 is None: at = before2; token = tokens[at]; value_ = before3; break
                end = match4.end()
                while ends[at] < end: at += 1
                if ends[at] > end: at = before2; token = tokens[at]; value_ = before3; break
                token = tokens[at]
                value_ = match4[0]
                break
        made = new_node(EnumValue)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.value = value_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_Setting():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        value_ = None
        taken1 = token; at += 1; token = tokens[at]
        name_ = taken1
        found = expression(at)
        if found is None: return None
        value, at = found; token = tokens[at]
        value_ = value
        made = new_node(Setting)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.value = value_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_CountRange():
        nonlocal at, token
        start = ends[at + 1] - 5
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        role_ = None
        lower_ = None
        upper_ = None
        at += 1; token = tokens[at]
        if not (token == 'of'): return None
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_node(Ref)
        value.name = taken1
        value.kind = 'Role'
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        value.target = None
        role_ = value
        if not (token == 'in'): return None
        at += 1; token = tokens[at]
        found = expression(at)
        if found is None: return None
        value, at = found; token = tokens[at]
        lower_ = value
        if not (token == '.' and tokens[at + 1] == '.' and ends[at + 2] == ends[at + 1] + 1): return None
        at += 2; token = tokens[at]
        found = expression(at)
        if found is None: return None
        value, at = found; token = tokens[at]
        upper_ = value
        made = new_node(CountRange)
        made.span = new_span(Span, (source, start, ends[at]))
        made.role = role_
        made.lower = lower_
        made.upper = upper_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_ParamRange():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        role_ = None
        param_ = None
        lower_ = None
        upper_ = None
        step_ = None
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_node(Ref)
        value.name = taken1
        value.kind = 'Role'
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        value.target = None
        role_ = value
        if not (token == '.'): return None
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): return None
        taken2 = token; at += 1; token = tokens[at]
        value = new_node(Ref)
        value.name = taken2
        value.kind = 'Param'
        value.span = new_span(Span, (source, ends[at] - len(taken2), ends[at]))
        value.target = None
        param_ = value
        if not (token == 'in'): return None
        at += 1; token = tokens[at]
        found = expression(at)
        if found is None: return None
        value, at = found; token = tokens[at]
        lower_ = value
        if not (token == '.' and tokens[at + 1] == '.' and ends[at + 2] == ends[at + 1] + 1): return None
        at += 2; token = tokens[at]
        found = expression(at)
        if found is None: return None
        value, at = found; token = tokens[at]
        upper_ = value
        if token == 'step':
            before3 = at
            before4 = step_
            while True:
                at += 1; token = tokens[at]
                found = expression(at)
                if found is None: at = before3; token = tokens[at]; step_ = before4; break
                value, at = found; token = tokens[at]
                step_ = value
                break
        made = new_node(ParamRange)
        made.span = new_span(Span, (source, start, ends[at]))
        made.role = role_
        made.param = param_
        made.lower = lower_
        made.upper = upper_
        made.step = step_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_Communication():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        paradigm_ = None
        name_ = None
        type_ = None
        taken1 = token; at += 1; token = tokens[at]
        paradigm_ = taken1
        first = ends[at + 1] - len(token)
        match2 = REGEX1(text, ends[at + 1] - len(token))
        if match2 is None: return None
        end = match2.end()
        while ends[at] < end: at += 1
        if ends[at] > end: return None
        token = tokens[at]
        value = new_word(Word, unquoted(match2[0]))
        value.span = new_span(Span, (source, first, ends[at]))
        name_ = value
        if not (token == ':'): return None
        at += 1; token = tokens[at]
        value = r_TypeRef()
        if value is None: return None
        type_ = value
        made = new_node(Communication)
        made.span = new_span(Span, (source, start, ends[at]))
        made.paradigm = paradigm_
        made.name = name_
        made.type = type_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_FunctionPort():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        direction_ = None
        topic_ = None
        type_ = None
        taken1 = token; at += 1; token = tokens[at]
        direction_ = taken1
        first = ends[at + 1] - len(token)
        match2 = REGEX1(text, ends[at + 1] - len(token))
        if match2 is None: return None
        end = match2.end()
        while ends[at] < end: at += 1
        if ends[at] > end: return None
        token = tokens[at]
        value = new_word(Word, unquoted(match2[0]))
        value.span = new_span(Span, (source, first, ends[at]))
        topic_ = value
        if not (token == ':'): return None
        at += 1; token = tokens[at]
        value = r_TypeRef()
        if value is None: return None
        type_ = value
        made = new_node(FunctionPort)
        made.span = new_span(Span, (source, start, ends[at]))
        made.direction = direction_
        made.topic = topic_
        made.type = type_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_Param():
        nonlocal at, token
        start = ends[at + 1] - 5
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        type_ = None
        default_ = None
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if not (token == ':'): return None
        at += 1; token = tokens[at]
        value = r_TypeRef()
        if value is None: return None
        type_ = value
        if token == '=':
            before2 = at
            before3 = default_
            while True:
                at += 1; token = tokens[at]
                found = expression(at)
                if found is None: at = before2; token = tokens[at]; default_ = before3; break
                value, at = found; token = tokens[at]
                default_ = value
                break
        made = new_node(Param)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.type = type_
        made.default = default_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_Port():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        direction_ = None
        name_ = None
        type_ = None
        topic_ = None
        taken1 = token; at += 1; token = tokens[at]
        direction_ = taken1
        first = ends[at + 1] - len(token)
        match2 = REGEX8(text, ends[at + 1] - len(token))
        if match2 is None: return None
        end = match2.end()
        while ends[at] < end: at += 1
        if ends[at] > end: return None
        token = tokens[at]
        value = new_word(Word, match2[0])
        value.span = new_span(Span, (source, first, ends[at]))
        name_ = value
        if not (token == ':'): return None
        at += 1; token = tokens[at]
        value = r_TypeRef()
        if value is None: return None
        type_ = value
        if token == 'on':
            before3 = at
            before4 = topic_
            while True:
                at += 1; token = tokens[at]
                first = ends[at + 1] - len(token)
                match5 = REGEX1(text, ends[at + 1] - len(token))
                if match5 is None: at = before3; token = tokens[at]; topic_ = before4; break
                end = match5.end()
                while ends[at] < end: at += 1
                if ends[at] > end: at = before3; token = tokens[at]; topic_ = before4; break
                token = tokens[at]
                value = new_word(Word, unquoted(match5[0]))
                value.span = new_span(Span, (source, first, ends[at]))
                topic_ = value
                break
        made = new_node(Port)
        made.span = new_span(Span, (source, start, ends[at]))
        made.direction = direction_
        made.name = name_
        made.type = type_
        made.topic = topic_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_Operation():
        nonlocal at, token
        start = ends[at + 1] - 9
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        parameters_ = []
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if not (token == '('): return None
        at += 1; token = tokens[at]
        if token >= 'A' and token not in SET3:
            before2 = at
            while True:
                value = r_Parameter()
                if value is None: at = before2; token = tokens[at]; break
                parameters_.append(value)
                while token == ',':
                    before3 = at
                    at += 1; token = tokens[at]
                    value = r_Parameter()
                    if value is None: at = before3; token = tokens[at]; break
                    parameters_.append(value)
                break
        if not (token == ')'): return None
        at += 1; token = tokens[at]
        made = new_node(Operation)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.parameters = parameters_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_BehaviorUse():
        nonlocal at, token
        start = ends[at + 1] - 8
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        machine_ = None
        at += 1; token = tokens[at]
        first = ends[at + 1] - len(token)
        if not (token >= 'A' and token not in SET2): return None
        taken2 = token; at += 1; token = tokens[at]
        text1 = taken2
        if token == '.':
            match3 = REGEX0(text, ends[at + 1] - len(token))
            if match3[0]:
                text1 += match3[0]
                end = match3.end()
                while ends[at] < end: at += 1
                if ends[at] > end: return None
                token = tokens[at]
        value = new_node(Ref)
        value.name = text1
        value.kind = 'StateMachine'
        value.span = new_span(Span, (source, first, first + len(text1)))
        value.target = None
        machine_ = value
        made = new_node(BehaviorUse)
        made.span = new_span(Span, (source, start, ends[at]))
        made.machine = machine_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_CommunicationSettings():
        nonlocal at, token
        start = ends[at + 1] - 13
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        technology_ = None
        values_ = []
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        technology_ = value
        if not (token == '{'): return None
        at += 1; token = tokens[at]
        while token >= 'A' and token not in SET3:
            before2 = at
            before3 = len(values_)
            value = r_PartValue()
            if value is None: at = before2; token = tokens[at]; del values_[before3:]; break
            values_.append(value)
            if token in SET4:
                at += 1; token = tokens[at]
        if not (token == '}'): return None
        at += 1; token = tokens[at]
        made = new_node(CommunicationSettings)
        made.span = new_span(Span, (source, start, ends[at]))
        made.technology = technology_
        made.values = values_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_Connector():
        nonlocal at, token
        start = ends[at + 1] - 7
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        source_ = None
        target_ = None
        at += 1; token = tokens[at]
        value = r_PortRef()
        if value is None: return None
        source_ = value
        if not (token == '-' and tokens[at + 1] == '>' and ends[at + 2] == ends[at + 1] + 1): return None
        at += 2; token = tokens[at]
        value = r_PortRef()
        if value is None: return None
        target_ = value
        made = new_node(Connector)
        made.span = new_span(Span, (source, start, ends[at]))
        made.source = source_
        made.target = target_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_Part():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        component_ = None
        values_ = []
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if not (token == ':'): return None
        at += 1; token = tokens[at]
        first = ends[at + 1] - len(token)
        if not (token >= 'A' and token not in SET2): return None
        taken3 = token; at += 1; token = tokens[at]
        text2 = taken3
        if token == '.':
            match4 = REGEX0(text, ends[at + 1] - len(token))
            if match4[0]:
                text2 += match4[0]
                end = match4.end()
                while ends[at] < end: at += 1
                if ends[at] > end: return None
                token = tokens[at]
        value = new_node(Ref)
        value.name = text2
        value.kind = 'Component'
        value.span = new_span(Span, (source, first, first + len(text2)))
        value.target = None
        component_ = value
        if token == '{':
            before5 = at
            before6 = len(values_)
            while True:
                at += 1; token = tokens[at]
                while token >= 'A' and token not in SET3:
                    before7 = at
                    before8 = len(values_)
                    value = r_PartValue()
                    if value is None: at = before7; token = tokens[at]; del values_[before8:]; break
                    values_.append(value)
                    if token in SET4:
                        at += 1; token = tokens[at]
                if not (token == '}'): at = before5; token = tokens[at]; del values_[before6:]; break
                at += 1; token = tokens[at]
                break
        made = new_node(Part)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.component = component_
        made.values = values_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_Variable():
        nonlocal at, token
        start = ends[at + 1] - 3
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        type_ = None
        initial_ = None
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if not (token == ':'): return None
        at += 1; token = tokens[at]
        value = r_TypeRef()
        if value is None: return None
        type_ = value
        if token == '=':
            before2 = at
            before3 = initial_
            while True:
                at += 1; token = tokens[at]
                found = expression(at)
                if found is None: at = before2; token = tokens[at]; initial_ = before3; break
                value, at = found; token = tokens[at]
                initial_ = value
                break
        made = new_node(Variable)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.type = type_
        made.initial = initial_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_Initial():
        nonlocal at, token
        start = ends[at + 1] - 7
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        target_ = None
        at += 1; token = tokens[at]
        first = ends[at + 1] - len(token)
        if not (token >= 'A' and token not in SET2): return None
        taken2 = token; at += 1; token = tokens[at]
        text1 = taken2
        if token == '.':
            match3 = REGEX0(text, ends[at + 1] - len(token))
            if match3[0]:
                text1 += match3[0]
                end = match3.end()
                while ends[at] < end: at += 1
                if ends[at] > end: return None
                token = tokens[at]
        value = new_node(Ref)
        value.name = text1
        value.kind = 'Vertex'
        value.span = new_span(Span, (source, first, first + len(text1)))
        value.target = None
        target_ = value
        made = new_node(Initial)
        made.span = new_span(Span, (source, start, ends[at]))
        made.target = target_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_EnvironmentUse():
        nonlocal at, token
        start = ends[at + 1] - 11
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        environment_ = None
        at += 1; token = tokens[at]
        first = ends[at + 1] - len(token)
        if not (token >= 'A' and token not in SET2): return None
        taken2 = token; at += 1; token = tokens[at]
        text1 = taken2
        if token == '.':
            match3 = REGEX0(text, ends[at + 1] - len(token))
            if match3[0]:
                text1 += match3[0]
                end = match3.end()
                while ends[at] < end: at += 1
                if ends[at] > end: return None
                token = tokens[at]
        value = new_node(Ref)
        value.name = text1
        value.kind = 'Environment'
        value.span = new_span(Span, (source, first, first + len(text1)))
        value.target = None
        environment_ = value
        made = new_node(EnvironmentUse)
        made.span = new_span(Span, (source, start, ends[at]))
        made.environment = environment_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_FitnessUse():
        nonlocal at, token
        start = ends[at + 1] - 7
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        fitness_ = None
        at += 1; token = tokens[at]
        first = ends[at + 1] - len(token)
        if not (token >= 'A' and token not in SET2): return None
        taken2 = token; at += 1; token = tokens[at]
        text1 = taken2
        if token == '.':
            match3 = REGEX0(text, ends[at + 1] - len(token))
            if match3[0]:
                text1 += match3[0]
                end = match3.end()
                while ends[at] < end: at += 1
                if ends[at] > end: return None
                token = tokens[at]
        value = new_node(Ref)
        value.name = text1
        value.kind = 'Fitness'
        value.span = new_span(Span, (source, first, first + len(text1)))
        value.target = None
        fitness_ = value
        made = new_node(FitnessUse)
        made.span = new_span(Span, (source, start, ends[at]))
        made.fitness = fitness_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_Role():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        member_ = None
        multiplicity_ = None
        values_ = []
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if not (token == ':'): return None
        at += 1; token = tokens[at]
        first = ends[at + 1] - len(token)
        if not (token >= 'A' and token not in SET2): return None
        taken3 = token; at += 1; token = tokens[at]
        text2 = taken3
        if token == '.':
            match4 = REGEX0(text, ends[at + 1] - len(token))
            if match4[0]:
                text2 += match4[0]
                end = match4.end()
                while ends[at] < end: at += 1
                if ends[at] > end: return None
                token = tokens[at]
        value = new_node(Ref)
        value.name = text2
        value.kind = 'Member'
        value.span = new_span(Span, (source, first, first + len(text2)))
        value.target = None
        member_ = value
        if token == '[':
            before5 = at
            before6 = multiplicity_
            while True:
                at += 1; token = tokens[at]
                value = r_Multiplicity()
                if value is None: at = before5; token = tokens[at]; multiplicity_ = before6; break
                multiplicity_ = value
                if not (token == ']'): at = before5; token = tokens[at]; multiplicity_ = before6; break
                at += 1; token = tokens[at]
                break
        if token == '{':
            before7 = at
            before8 = len(values_)
            while True:
                at += 1; token = tokens[at]
                while token >= 'A' and token not in SET3:
                    before9 = at
                    before10 = len(values_)
                    value = r_PartValue()
                    if value is None: at = before9; token = tokens[at]; del values_[before10:]; break
                    values_.append(value)
                    if token in SET4:
                        at += 1; token = tokens[at]
                if not (token == '}'): at = before7; token = tokens[at]; del values_[before8:]; break
                at += 1; token = tokens[at]
                break
        made = new_node(Role)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.member = member_
        made.multiplicity = multiplicity_
        made.values = values_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_RobotValues():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        role_ = None
        index_ = None
        values_ = []
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_node(Ref)
        value.name = taken1
        value.kind = 'Role'
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        value.target = None
        role_ = value
        if not (token == '['): return None
        at += 1; token = tokens[at]
        match2 = REGEX9(text, ends[at + 1] - len(token))
        if match2 is None: return None
        end = match2.end()
        while ends[at] < end: at += 1
        if ends[at] > end: return None
        token = tokens[at]
        index_ = match2[0]
        if not (token == ']'): return None
        at += 1; token = tokens[at]
        if not (token == '{'): return None
        at += 1; token = tokens[at]
        while token >= 'A' and token not in SET3:
            before3 = at
            before4 = len(values_)
            value = r_PartValue()
            if value is None: at = before3; token = tokens[at]; del values_[before4:]; break
            values_.append(value)
            if token in SET4:
                at += 1; token = tokens[at]
        if not (token == '}'): return None
        at += 1; token = tokens[at]
        made = new_node(RobotValues)
        made.span = new_span(Span, (source, start, ends[at]))
        made.role = role_
        made.index = index_
        made.values = values_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_World():
        nonlocal at, token
        start = ends[at + 1] - 5
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        file_ = None
        at += 1; token = tokens[at]
        first = ends[at + 1] - len(token)
        match1 = REGEX1(text, ends[at + 1] - len(token))
        if match1 is None: return None
        end = match1.end()
        while ends[at] < end: at += 1
        if ends[at] > end: return None
        token = tokens[at]
        value = new_word(Word, unquoted(match1[0]))
        value.span = new_span(Span, (source, first, ends[at]))
        file_ = value
        made = new_node(World)
        made.span = new_span(Span, (source, start, ends[at]))
        made.file = file_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_Size():
        nonlocal at, token
        start = ends[at + 1] - 4
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        width_ = None
        depth_ = None
        height_ = None
        at += 1; token = tokens[at]
        match1 = REGEX10(text, ends[at + 1] - len(token))
        if match1 is None: return None
        end = match1.end()
        while ends[at] < end: at += 1
        if ends[at] > end: return None
        token = tokens[at]
        width_ = match1[0]
        if not (token == 'x'): return None
        at += 1; token = tokens[at]
        match2 = REGEX10(text, ends[at + 1] - len(token))
        if match2 is None: return None
        end = match2.end()
        while ends[at] < end: at += 1
        if ends[at] > end: return None
        token = tokens[at]
        depth_ = match2[0]
        if token == 'x':
            before3 = at
            before4 = height_
            while True:
                at += 1; token = tokens[at]
                match5 = REGEX10(text, ends[at + 1] - len(token))
                if match5 is None: at = before3; token = tokens[at]; height_ = before4; break
                end = match5.end()
                while ends[at] < end: at += 1
                if ends[at] > end: at = before3; token = tokens[at]; height_ = before4; break
                token = tokens[at]
                height_ = match5[0]
                break
        made = new_node(Size)
        made.span = new_span(Span, (source, start, ends[at]))
        made.width = width_
        made.depth = depth_
        made.height = height_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_FitnessInput():
        nonlocal at, token
        start = ends[at + 1] - 2
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        type_ = None
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if not (token == ':'): return None
        at += 1; token = tokens[at]
        value = r_TypeRef()
        if value is None: return None
        type_ = value
        made = new_node(FitnessInput)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.type = type_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_Objective():
        nonlocal at, token
        start = ends[at + 1] - 8
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        goal_ = None
        value_ = None
        taken1 = token; at += 1; token = tokens[at]
        goal_ = taken1
        found = expression(at)
        if found is None: return None
        value, at = found; token = tokens[at]
        value_ = value
        made = new_node(Objective)
        made.span = new_span(Span, (source, start, ends[at]))
        made.goal = goal_
        made.value = value_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_Parameter():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        direction_ = None
        name_ = None
        type_ = None
        chosen1 = False
        if not chosen1 and token in SET14:
            before2 = at
            before3 = direction_
            before4 = name_
            while True:
                taken5 = token; at += 1; token = tokens[at]
                direction_ = taken5
                if not (token >= 'A' and token not in SET3): at = before2; token = tokens[at]; direction_ = before3; name_ = before4; break
                taken6 = token; at += 1; token = tokens[at]
                value = new_word(Word, taken6)
                value.span = new_span(Span, (source, ends[at] - len(taken6), ends[at]))
                name_ = value
                chosen1 = True
                break
        if not chosen1 and token >= 'A' and token not in SET3:
            before7 = at
            while True:
                taken8 = token; at += 1; token = tokens[at]
                value = new_word(Word, taken8)
                value.span = new_span(Span, (source, ends[at] - len(taken8), ends[at]))
                name_ = value
                chosen1 = True
                break
        if not chosen1: return None
        if not (token == ':'): return None
        at += 1; token = tokens[at]
        value = r_TypeRef()
        if value is None: return None
        type_ = value
        made = new_node(Parameter)
        made.span = new_span(Span, (source, start, ends[at]))
        made.direction = direction_
        made.name = name_
        made.type = type_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_PartValue():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        if find('\n', ends[at], start) < 0: inline[at] = ','
        name_ = None
        value_ = None
        if not (token >= 'A' and token not in SET3): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if not (token == '='): return None
        at += 1; token = tokens[at]
        found = expression(at)
        if found is None: return None
        value, at = found; token = tokens[at]
        value_ = value
        made = new_node(PartValue)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.value = value_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_PortRef():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        part_ = None
        port_ = None
        if token >= 'A' and token not in SET2:
            before1 = at
            before2 = part_
            while True:
                taken3 = token; at += 1; token = tokens[at]
                value = new_node(Ref)
                value.name = taken3
                value.kind = 'Part'
                value.span = new_span(Span, (source, ends[at] - len(taken3), ends[at]))
                value.target = None
                part_ = value
                if not (token == '.'): at = before1; token = tokens[at]; part_ = before2; break
                at += 1; token = tokens[at]
                break
        first = ends[at + 1] - len(token)
        match4 = REGEX8(text, ends[at + 1] - len(token))
        if match4 is None: return None
        end = match4.end()
        while ends[at] < end: at += 1
        if ends[at] > end: return None
        token = tokens[at]
        value = new_node(Ref)
        value.name = match4[0]
        value.kind = 'Port'
        value.span = new_span(Span, (source, first, first + len(match4[0])))
        value.target = None
        port_ = value
        made = new_node(PortRef)
        made.span = new_span(Span, (source, start, ends[at]))
        made.part = part_
        made.port = port_
        return made

    def r_State():
        nonlocal at, token, depth
        depth += 1
        if depth > limit: raise TooDeepError
        start = ends[at + 1] - 5
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        machine_ = None
        bindings_ = []
        items_ = []
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): depth -= 1; return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if token == '=':
            before2 = at
            before3 = machine_
            before4 = len(bindings_)
            while True:
                at += 1; token = tokens[at]
                first = ends[at + 1] - len(token)
                if not (token >= 'A' and token not in SET2): at = before2; token = tokens[at]; machine_ = before3; del bindings_[before4:]; break
                taken6 = token; at += 1; token = tokens[at]
                text5 = taken6
                if token == '.':
                    match7 = REGEX0(text, ends[at + 1] - len(token))
                    if match7[0]:
                        text5 += match7[0]
                        end = match7.end()
                        while ends[at] < end: at += 1
                        if ends[at] > end: at = before2; token = tokens[at]; machine_ = before3; del bindings_[before4:]; break
                        token = tokens[at]
                value = new_node(Ref)
                value.name = text5
                value.kind = 'StateMachine'
                value.span = new_span(Span, (source, first, first + len(text5)))
                value.target = None
                machine_ = value
                if token == '(':
                    before8 = at
                    before9 = len(bindings_)
                    while True:
                        at += 1; token = tokens[at]
                        if token >= 'A' and token not in SET3:
                            before10 = at
                            while True:
                                value = r_Argument()
                                if value is None: at = before10; token = tokens[at]; break
                                bindings_.append(value)
                                while token == ',':
                                    before11 = at
                                    at += 1; token = tokens[at]
                                    value = r_Argument()
                                    if value is None: at = before11; token = tokens[at]; break
                                    bindings_.append(value)
                                break
                        if not (token == ')'): at = before8; token = tokens[at]; del bindings_[before9:]; break
                        at += 1; token = tokens[at]
                        break
                break
        if token == '{':
            before12 = at
            before13 = len(items_)
            while True:
                at += 1; token = tokens[at]
                while token in SET15:
                    before14 = at
                    before15 = len(items_)
                    rule = StateItem_RULES.get(token)
                    if rule is None: at = before14; token = tokens[at]; del items_[before15:]; break
                    value = rule()
                    if value is None: at = before14; token = tokens[at]; del items_[before15:]; break
                    items_.append(value)
                    if token == ';':
                        at += 1; token = tokens[at]
                if not (token == '}'): at = before12; token = tokens[at]; del items_[before13:]; break
                at += 1; token = tokens[at]
                break
        depth -= 1
        made = new_node(State)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.machine = machine_
        made.bindings = bindings_
        made.items = items_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_Parallel():
        nonlocal at, token, depth
        depth += 1
        if depth > limit: raise TooDeepError
        start = ends[at + 1] - 8
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        items_ = []
        at += 1; token = tokens[at]
        if not (token == 'state'): depth -= 1; return None
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): depth -= 1; return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if not (token == '{'): depth -= 1; return None
        at += 1; token = tokens[at]
        while token in SET16:
            before2 = at
            before3 = len(items_)
            rule = ParallelItem_RULES.get(token)
            if rule is None: at = before2; token = tokens[at]; del items_[before3:]; break
            value = rule()
            if value is None: at = before2; token = tokens[at]; del items_[before3:]; break
            items_.append(value)
            if token == ';':
                at += 1; token = tokens[at]
        if not (token == '}'): depth -= 1; return None
        at += 1; token = tokens[at]
        depth -= 1
        made = new_node(Parallel)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.items = items_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_Choice():
        nonlocal at, token
        start = ends[at + 1] - 6
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        branches_ = []
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if not (token == '{'): return None
        at += 1; token = tokens[at]
        while token in SET17:
            before2 = at
            before3 = len(branches_)
            value = r_Branch()
            if value is None: at = before2; token = tokens[at]; del branches_[before3:]; break
            branches_.append(value)
            if token == ';':
                at += 1; token = tokens[at]
        if not (token == '}'): return None
        at += 1; token = tokens[at]
        made = new_node(Choice)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.branches = branches_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_History():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        deep_ = False
        name_ = None
        target_ = None
        if token == 'deep':
            at += 1; token = tokens[at]
            deep_ = True
        if not (token == 'history'): return None
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if token == '-':
            before2 = at
            before3 = target_
            while True:
                if not (token == '-' and tokens[at + 1] == '>' and ends[at + 2] == ends[at + 1] + 1): at = before2; token = tokens[at]; target_ = before3; break
                at += 2; token = tokens[at]
                first = ends[at + 1] - len(token)
                if not (token >= 'A' and token not in SET2): at = before2; token = tokens[at]; target_ = before3; break
                taken5 = token; at += 1; token = tokens[at]
                text4 = taken5
                if token == '.':
                    match6 = REGEX0(text, ends[at + 1] - len(token))
                    if match6[0]:
                        text4 += match6[0]
                        end = match6.end()
                        while ends[at] < end: at += 1
                        if ends[at] > end: at = before2; token = tokens[at]; target_ = before3; break
                        token = tokens[at]
                value = new_node(Ref)
                value.name = text4
                value.kind = 'Vertex'
                value.span = new_span(Span, (source, first, first + len(text4)))
                value.target = None
                target_ = value
                break
        made = new_node(History)
        made.span = new_span(Span, (source, start, ends[at]))
        made.deep = deep_
        made.name = name_
        made.target = target_
        made.doc = docs.pop(start) if start in docs else ''
        made.initial = None
        return made

    def r_FinalState():
        nonlocal at, token
        start = ends[at + 1] - 5
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        made = new_node(FinalState)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_Multiplicity():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        lower_ = None
        upper_ = None
        match1 = REGEX11(text, ends[at + 1] - len(token))
        if match1 is None: return None
        end = match1.end()
        while ends[at] < end: at += 1
        if ends[at] > end: return None
        token = tokens[at]
        lower_ = match1[0]
        if token == '.':
            before2 = at
            before3 = upper_
            while True:
                if not (token == '.' and tokens[at + 1] == '.' and ends[at + 2] == ends[at + 1] + 1): at = before2; token = tokens[at]; upper_ = before3; break
                at += 2; token = tokens[at]
                match4 = REGEX11(text, ends[at + 1] - len(token))
                if match4 is None: at = before2; token = tokens[at]; upper_ = before3; break
                end = match4.end()
                while ends[at] < end: at += 1
                if ends[at] > end: at = before2; token = tokens[at]; upper_ = before3; break
                token = tokens[at]
                upper_ = match4[0]
                break
        made = new_node(Multiplicity)
        made.span = new_span(Span, (source, start, ends[at]))
        made.lower = lower_
        made.upper = upper_
        return made

    def r_Argument():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        name_ = None
        value_ = None
        if not (token >= 'A' and token not in SET3): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if not (token == '='): return None
        at += 1; token = tokens[at]
        found = expression(at)
        if found is None: return None
        value, at = found; token = tokens[at]
        value_ = value
        made = new_node(Argument)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.value = value_
        return made

    def r_Branch():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        guard_ = None
        otherwise_ = ''
        effects_ = []
        target_ = None
        if token == '[':
            at += 1; token = tokens[at]
            found = expression(at)
            if found is None: return None
            value, at = found; token = tokens[at]
            guard_ = value
            if not (token == ']'): return None
            at += 1; token = tokens[at]
        elif token == 'else':
            at += 1; token = tokens[at]
            otherwise_ = 'else'
        else: return None
        if token == '/':
            before1 = at
            before2 = len(effects_)
            while True:
                at += 1; token = tokens[at]
                rule = Effect_RULES.get(token, r_Assignment)
                value = rule()
                if value is None: at = before1; token = tokens[at]; del effects_[before2:]; break
                effects_.append(value)
                while token == ',':
                    before3 = at
                    at += 1; token = tokens[at]
                    rule = Effect_RULES.get(token, r_Assignment)
                    value = rule()
                    if value is None: at = before3; token = tokens[at]; break
                    effects_.append(value)
                break
        if not (token == '-' and tokens[at + 1] == '>' and ends[at + 2] == ends[at + 1] + 1): return None
        at += 2; token = tokens[at]
        first = ends[at + 1] - len(token)
        if not (token >= 'A' and token not in SET2): return None
        taken5 = token; at += 1; token = tokens[at]
        text4 = taken5
        if token == '.':
            match6 = REGEX0(text, ends[at + 1] - len(token))
            if match6[0]:
                text4 += match6[0]
                end = match6.end()
                while ends[at] < end: at += 1
                if ends[at] > end: return None
                token = tokens[at]
        value = new_node(Ref)
        value.name = text4
        value.kind = 'Vertex'
        value.span = new_span(Span, (source, first, first + len(text4)))
        value.target = None
        target_ = value
        made = new_node(Branch)
        made.span = new_span(Span, (source, start, ends[at]))
        made.guard = guard_
        made.otherwise = otherwise_
        made.effects = effects_
        made.target = target_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_Activity():
        nonlocal at, token
        start = ends[at + 1] - 2
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        function_ = None
        goal_callback_ = None
        arguments_ = []
        result_callback_ = None
        results_ = []
        at += 1; token = tokens[at]
        first = ends[at + 1] - len(token)
        if not (token >= 'A' and token not in SET2): return None
        taken2 = token; at += 1; token = tokens[at]
        text1 = taken2
        if token == '.':
            match3 = REGEX0(text, ends[at + 1] - len(token))
            if match3[0]:
                text1 += match3[0]
                end = match3.end()
                while ends[at] < end: at += 1
                if ends[at] > end: return None
                token = tokens[at]
        value = new_node(Ref)
        value.name = text1
        value.kind = 'Function'
        value.span = new_span(Span, (source, first, first + len(text1)))
        value.target = None
        function_ = value
        if token == '(':
            before4 = at
            before5 = goal_callback_
            before6 = len(arguments_)
            while True:
                at += 1; token = tokens[at]
                chosen7 = False
                if not chosen7 and token == 'by':
                    before8 = at
                    before9 = goal_callback_
                    while True:
                        at += 1; token = tokens[at]
                        if not (token >= 'A' and token not in SET2): at = before8; token = tokens[at]; goal_callback_ = before9; break
                        taken10 = token; at += 1; token = tokens[at]
                        value = new_word(Word, taken10)
                        value.span = new_span(Span, (source, ends[at] - len(taken10), ends[at]))
                        goal_callback_ = value
                        chosen7 = True
                        break
                if not chosen7 and True:
                    before11 = at
                    before12 = len(arguments_)
                    while True:
                        if token >= 'A' and token not in SET3:
                            before13 = at
                            while True:
                                value = r_Argument()
                                if value is None: at = before13; token = tokens[at]; break
                                arguments_.append(value)
                                while token == ',':
                                    before14 = at
                                    at += 1; token = tokens[at]
                                    value = r_Argument()
                                    if value is None: at = before14; token = tokens[at]; break
                                    arguments_.append(value)
                                break
                        chosen7 = True
                        break
                if not chosen7: at = before4; token = tokens[at]; goal_callback_ = before5; del arguments_[before6:]; break
                if not (token == ')'): at = before4; token = tokens[at]; goal_callback_ = before5; del arguments_[before6:]; break
                at += 1; token = tokens[at]
                break
        if token == 'gives':
            before15 = at
            before16 = result_callback_
            before17 = len(results_)
            while True:
                at += 1; token = tokens[at]
                if token == 'by':
                    at += 1; token = tokens[at]
                    if not (token >= 'A' and token not in SET2): at = before15; token = tokens[at]; result_callback_ = before16; del results_[before17:]; break
                    taken18 = token; at += 1; token = tokens[at]
                    value = new_word(Word, taken18)
                    value.span = new_span(Span, (source, ends[at] - len(taken18), ends[at]))
                    result_callback_ = value
                elif token == '(':
                    at += 1; token = tokens[at]
                    value = r_ResultMapping()
                    if value is None: at = before15; token = tokens[at]; result_callback_ = before16; del results_[before17:]; break
                    results_.append(value)
                    while token == ',':
                        before19 = at
                        at += 1; token = tokens[at]
                        value = r_ResultMapping()
                        if value is None: at = before19; token = tokens[at]; break
                        results_.append(value)
                    if not (token == ')'): at = before15; token = tokens[at]; result_callback_ = before16; del results_[before17:]; break
                    at += 1; token = tokens[at]
                else: at = before15; token = tokens[at]; result_callback_ = before16; del results_[before17:]; break
                break
        made = new_node(Activity)
        made.span = new_span(Span, (source, start, ends[at]))
        made.function = function_
        made.goal_callback = goal_callback_
        made.arguments = arguments_
        made.result_callback = result_callback_
        made.results = results_
        made.doc = docs.pop(start) if start in docs else ''
        made.owner = None
        return made

    def r_Entry():
        nonlocal at, token
        start = ends[at + 1] - 5
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        effects_ = []
        at += 1; token = tokens[at]
        if not (token == '/'): return None
        at += 1; token = tokens[at]
        rule = Effect_RULES.get(token, r_Assignment)
        value = rule()
        if value is None: return None
        effects_.append(value)
        while token == ',':
            before1 = at
            at += 1; token = tokens[at]
            rule = Effect_RULES.get(token, r_Assignment)
            value = rule()
            if value is None: at = before1; token = tokens[at]; break
            effects_.append(value)
        made = new_node(Entry)
        made.span = new_span(Span, (source, start, ends[at]))
        made.effects = effects_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_Exit():
        nonlocal at, token
        start = ends[at + 1] - 4
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        effects_ = []
        at += 1; token = tokens[at]
        if not (token == '/'): return None
        at += 1; token = tokens[at]
        rule = Effect_RULES.get(token, r_Assignment)
        value = rule()
        if value is None: return None
        effects_.append(value)
        while token == ',':
            before1 = at
            at += 1; token = tokens[at]
            rule = Effect_RULES.get(token, r_Assignment)
            value = rule()
            if value is None: at = before1; token = tokens[at]; break
            effects_.append(value)
        made = new_node(Exit)
        made.span = new_span(Span, (source, start, ends[at]))
        made.effects = effects_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_Transition():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        internal_ = False
        triggers_ = []
        guard_ = None
        effects_ = []
        target_ = None
        if token == 'internal':
            at += 1; token = tokens[at]
            internal_ = True
        chosen1 = False
        if not chosen1 and token in SET18:
            before2 = at
            before3 = len(triggers_)
            before4 = guard_
            before5 = len(effects_)
            before6 = target_
            while True:
                if token == 'on':
                    at += 1; token = tokens[at]
                    rule = Trigger_RULES.get(token, try_DoneTrigger_EventTrigger)
                    value = rule()
                    if value is None: at = before2; token = tokens[at]; del triggers_[before3:]; guard_ = before4; del effects_[before5:]; target_ = before6; break
                    triggers_.append(value)
                    while token == ',':
                        before7 = at
                        at += 1; token = tokens[at]
                        rule = Trigger_RULES.get(token, try_DoneTrigger_EventTrigger)
                        value = rule()
                        if value is None: at = before7; token = tokens[at]; break
                        triggers_.append(value)
                elif token == 'after':
                    value = r_TimeTrigger()
                    if value is None: at = before2; token = tokens[at]; del triggers_[before3:]; guard_ = before4; del effects_[before5:]; target_ = before6; break
                    triggers_.append(value)
                    while token == ',':
                        before8 = at
                        at += 1; token = tokens[at]
                        if not (token == 'after'): at = before8; token = tokens[at]; break
                        value = r_TimeTrigger()
                        if value is None: at = before8; token = tokens[at]; break
                        triggers_.append(value)
                elif token == 'monitor':
                    value = r_MonitorTrigger()
                    if value is None: at = before2; token = tokens[at]; del triggers_[before3:]; guard_ = before4; del effects_[before5:]; target_ = before6; break
                    triggers_.append(value)
                    while token == ',':
                        before9 = at
                        at += 1; token = tokens[at]
                        if not (token == 'monitor'): at = before9; token = tokens[at]; break
                        value = r_MonitorTrigger()
                        if value is None: at = before9; token = tokens[at]; break
                        triggers_.append(value)
                else: at = before2; token = tokens[at]; del triggers_[before3:]; guard_ = before4; del effects_[before5:]; target_ = before6; break
                if token == '[':
                    before10 = at
                    before11 = guard_
                    while True:
                        at += 1; token = tokens[at]
                        found = expression(at)
                        if found is None: at = before10; token = tokens[at]; guard_ = before11; break
                        value, at = found; token = tokens[at]
                        guard_ = value
                        if not (token == ']'): at = before10; token = tokens[at]; guard_ = before11; break
                        at += 1; token = tokens[at]
                        break
                if token == '/':
                    at += 1; token = tokens[at]
                    rule = Effect_RULES.get(token, r_Assignment)
                    value = rule()
                    if value is None: at = before2; token = tokens[at]; del triggers_[before3:]; guard_ = before4; del effects_[before5:]; target_ = before6; break
                    effects_.append(value)
                    while token == ',':
                        before12 = at
                        at += 1; token = tokens[at]
                        rule = Effect_RULES.get(token, r_Assignment)
                        value = rule()
                        if value is None: at = before12; token = tokens[at]; break
                        effects_.append(value)
                    if token == '-':
                        before13 = at
                        before14 = target_
                        while True:
                            if not (token == '-' and tokens[at + 1] == '>' and ends[at + 2] == ends[at + 1] + 1): at = before13; token = tokens[at]; target_ = before14; break
                            at += 2; token = tokens[at]
                            first = ends[at + 1] - len(token)
                            if not (token >= 'A' and token not in SET2): at = before13; token = tokens[at]; target_ = before14; break
                            taken16 = token; at += 1; token = tokens[at]
                            text15 = taken16
                            if token == '.':
                                match17 = REGEX0(text, ends[at + 1] - len(token))
                                if match17[0]:
                                    text15 += match17[0]
                                    end = match17.end()
                                    while ends[at] < end: at += 1
                                    if ends[at] > end: at = before13; token = tokens[at]; target_ = before14; break
                                    token = tokens[at]
                            value = new_node(Ref)
                            value.name = text15
                            value.kind = 'Vertex'
                            value.span = new_span(Span, (source, first, first + len(text15)))
                            value.target = None
                            target_ = value
                            break
                elif token == '-':
                    if not (token == '-' and tokens[at + 1] == '>' and ends[at + 2] == ends[at + 1] + 1): at = before2; token = tokens[at]; del triggers_[before3:]; guard_ = before4; del effects_[before5:]; target_ = before6; break
                    at += 2; token = tokens[at]
                    first = ends[at + 1] - len(token)
                    if not (token >= 'A' and token not in SET2): at = before2; token = tokens[at]; del triggers_[before3:]; guard_ = before4; del effects_[before5:]; target_ = before6; break
                    taken19 = token; at += 1; token = tokens[at]
                    text18 = taken19
                    if token == '.':
                        match20 = REGEX0(text, ends[at + 1] - len(token))
                        if match20[0]:
                            text18 += match20[0]
                            end = match20.end()
                            while ends[at] < end: at += 1
                            if ends[at] > end: at = before2; token = tokens[at]; del triggers_[before3:]; guard_ = before4; del effects_[before5:]; target_ = before6; break
                            token = tokens[at]
                    value = new_node(Ref)
                    value.name = text18
                    value.kind = 'Vertex'
                    value.span = new_span(Span, (source, first, first + len(text18)))
                    value.target = None
                    target_ = value
                else: at = before2; token = tokens[at]; del triggers_[before3:]; guard_ = before4; del effects_[before5:]; target_ = before6; break
                chosen1 = True
                break
        if not chosen1 and token == 'on':
            before21 = at
            before22 = len(triggers_)
            while True:
                at += 1; token = tokens[at]
                if not (token in SET19): at = before21; token = tokens[at]; del triggers_[before22:]; break
                value = r_OutcomeTrigger()
                if value is None: at = before21; token = tokens[at]; del triggers_[before22:]; break
                triggers_.append(value)
                while token == ',':
                    before23 = at
                    at += 1; token = tokens[at]
                    if not (token in SET19): at = before23; token = tokens[at]; break
                    value = r_OutcomeTrigger()
                    if value is None: at = before23; token = tokens[at]; break
                    triggers_.append(value)
                chosen1 = True
                break
        if not chosen1 and token == '[':
            before24 = at
            before25 = guard_
            before26 = len(effects_)
            before27 = target_
            while True:
                at += 1; token = tokens[at]
                found = expression(at)
                if found is None: at = before24; token = tokens[at]; guard_ = before25; del effects_[before26:]; target_ = before27; break
                value, at = found; token = tokens[at]
                guard_ = value
                if not (token == ']'): at = before24; token = tokens[at]; guard_ = before25; del effects_[before26:]; target_ = before27; break
                at += 1; token = tokens[at]
                if token == '/':
                    before28 = at
                    before29 = len(effects_)
                    while True:
                        at += 1; token = tokens[at]
                        rule = Effect_RULES.get(token, r_Assignment)
                        value = rule()
                        if value is None: at = before28; token = tokens[at]; del effects_[before29:]; break
                        effects_.append(value)
                        while token == ',':
                            before30 = at
                            at += 1; token = tokens[at]
                            rule = Effect_RULES.get(token, r_Assignment)
                            value = rule()
                            if value is None: at = before30; token = tokens[at]; break
                            effects_.append(value)
                        break
                if not (token == '-' and tokens[at + 1] == '>' and ends[at + 2] == ends[at + 1] + 1): at = before24; token = tokens[at]; guard_ = before25; del effects_[before26:]; target_ = before27; break
                at += 2; token = tokens[at]
                first = ends[at + 1] - len(token)
                if not (token >= 'A' and token not in SET2): at = before24; token = tokens[at]; guard_ = before25; del effects_[before26:]; target_ = before27; break
                taken32 = token; at += 1; token = tokens[at]
                text31 = taken32
                if token == '.':
                    match33 = REGEX0(text, ends[at + 1] - len(token))
                    if match33[0]:
                        text31 += match33[0]
                        end = match33.end()
                        while ends[at] < end: at += 1
                        if ends[at] > end: at = before24; token = tokens[at]; guard_ = before25; del effects_[before26:]; target_ = before27; break
                        token = tokens[at]
                value = new_node(Ref)
                value.name = text31
                value.kind = 'Vertex'
                value.span = new_span(Span, (source, first, first + len(text31)))
                value.target = None
                target_ = value
                chosen1 = True
                break
        if not chosen1: return None
        made = new_node(Transition)
        made.span = new_span(Span, (source, start, ends[at]))
        made.internal = internal_
        made.triggers = triggers_
        made.guard = guard_
        made.effects = effects_
        made.target = target_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_Region():
        nonlocal at, token, depth
        depth += 1
        if depth > limit: raise TooDeepError
        start = ends[at + 1] - 6
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        items_ = []
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): depth -= 1; return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if not (token == '{'): depth -= 1; return None
        at += 1; token = tokens[at]
        while token in SET20:
            before2 = at
            before3 = len(items_)
            rule = RegionItem_RULES.get(token)
            if rule is None: at = before2; token = tokens[at]; del items_[before3:]; break
            value = rule()
            if value is None: at = before2; token = tokens[at]; del items_[before3:]; break
            items_.append(value)
            if token == ';':
                at += 1; token = tokens[at]
        if not (token == '}'): depth -= 1; return None
        at += 1; token = tokens[at]
        depth -= 1
        made = new_node(Region)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.items = items_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_ResultMapping():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        field_ = None
        target_ = None
        if not (token >= 'A' and token not in SET3): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        field_ = value
        if not (token == '=' and tokens[at + 1] == '>' and ends[at + 2] == ends[at + 1] + 1): return None
        at += 2; token = tokens[at]
        found = operand(at)
        if found is None: return None
        value, at = found; token = tokens[at]
        target_ = value
        made = new_node(ResultMapping)
        made.span = new_span(Span, (source, start, ends[at]))
        made.field = field_
        made.target = target_
        return made

    def r_TimeTrigger():
        nonlocal at, token
        start = ends[at + 1] - 5
        delay_ = None
        at += 1; token = tokens[at]
        found = delay(at)
        if found is None: return None
        value, at = found; token = tokens[at]
        delay_ = value
        made = new_node(TimeTrigger)
        made.span = new_span(Span, (source, start, ends[at]))
        made.delay = delay_
        return made

    def r_MonitorTrigger():
        nonlocal at, token
        start = ends[at + 1] - 7
        topic_ = None
        type_ = None
        name_ = None
        at += 1; token = tokens[at]
        first = ends[at + 1] - len(token)
        match1 = REGEX1(text, ends[at + 1] - len(token))
        if match1 is None: return None
        end = match1.end()
        while ends[at] < end: at += 1
        if ends[at] > end: return None
        token = tokens[at]
        value = new_word(Word, unquoted(match1[0]))
        value.span = new_span(Span, (source, first, ends[at]))
        topic_ = value
        if not (token == ':'): return None
        at += 1; token = tokens[at]
        value = r_TypeRef()
        if value is None: return None
        type_ = value
        if token == 'as':
            before2 = at
            before3 = name_
            while True:
                at += 1; token = tokens[at]
                if not (token >= 'A' and token not in SET2): at = before2; token = tokens[at]; name_ = before3; break
                taken4 = token; at += 1; token = tokens[at]
                value = new_word(Word, taken4)
                value.span = new_span(Span, (source, ends[at] - len(taken4), ends[at]))
                name_ = value
                break
        made = new_node(MonitorTrigger)
        made.span = new_span(Span, (source, start, ends[at]))
        made.topic = topic_
        made.type = type_
        made.name = name_
        return made

    def r_OutcomeTrigger():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        outcome_ = None
        taken1 = token; at += 1; token = tokens[at]
        outcome_ = taken1
        made = new_node(OutcomeTrigger)
        made.span = new_span(Span, (source, start, ends[at]))
        made.outcome = outcome_
        return made

    def r_Send():
        nonlocal at, token
        start = ends[at + 1] - 4
        event_ = None
        arguments_ = []
        to_ = None
        at += 1; token = tokens[at]
        first = ends[at + 1] - len(token)
        if not (token >= 'A' and token not in SET2): return None
        taken2 = token; at += 1; token = tokens[at]
        text1 = taken2
        if token == '.':
            match3 = REGEX0(text, ends[at + 1] - len(token))
            if match3[0]:
                text1 += match3[0]
                end = match3.end()
                while ends[at] < end: at += 1
                if ends[at] > end: return None
                token = tokens[at]
        value = new_node(Ref)
        value.name = text1
        value.kind = 'Event'
        value.span = new_span(Span, (source, first, first + len(text1)))
        value.target = None
        event_ = value
        if token == '(':
            before4 = at
            before5 = len(arguments_)
            while True:
                at += 1; token = tokens[at]
                if token >= 'A' and token not in SET3:
                    before6 = at
                    while True:
                        value = r_Argument()
                        if value is None: at = before6; token = tokens[at]; break
                        arguments_.append(value)
                        while token == ',':
                            before7 = at
                            at += 1; token = tokens[at]
                            value = r_Argument()
                            if value is None: at = before7; token = tokens[at]; break
                            arguments_.append(value)
                        break
                if not (token == ')'): at = before4; token = tokens[at]; del arguments_[before5:]; break
                at += 1; token = tokens[at]
                break
        if token == 'to':
            before8 = at
            before9 = to_
            while True:
                at += 1; token = tokens[at]
                value = r_Address()
                if value is None: at = before8; token = tokens[at]; to_ = before9; break
                to_ = value
                break
        made = new_node(Send)
        made.span = new_span(Span, (source, start, ends[at]))
        made.event = event_
        made.arguments = arguments_
        made.to = to_
        return made

    def r_Assignment():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        target_ = None
        value_ = None
        found = operand(at)
        if found is None: return None
        value, at = found; token = tokens[at]
        target_ = value
        if not (token == '='): return None
        at += 1; token = tokens[at]
        found = expression(at)
        if found is None: return None
        value, at = found; token = tokens[at]
        value_ = value
        made = new_node(Assignment)
        made.span = new_span(Span, (source, start, ends[at]))
        made.target = target_
        made.value = value_
        return made

    def r_DoneTrigger():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        region_ = None
        final_ = None
        if token >= 'A' and token not in SET2:
            before1 = at
            before2 = region_
            while True:
                taken3 = token; at += 1; token = tokens[at]
                value = new_node(Ref)
                value.name = taken3
                value.kind = 'Region'
                value.span = new_span(Span, (source, ends[at] - len(taken3), ends[at]))
                value.target = None
                region_ = value
                if not (token == '.'): at = before1; token = tokens[at]; region_ = before2; break
                at += 1; token = tokens[at]
                break
        if not (token == 'done'): return None
        at += 1; token = tokens[at]
        if token == '.':
            before4 = at
            before5 = final_
            while True:
                at += 1; token = tokens[at]
                if not (token >= 'A' and token not in SET2): at = before4; token = tokens[at]; final_ = before5; break
                taken6 = token; at += 1; token = tokens[at]
                value = new_node(Ref)
                value.name = taken6
                value.kind = 'FinalState'
                value.span = new_span(Span, (source, ends[at] - len(taken6), ends[at]))
                value.target = None
                final_ = value
                break
        made = new_node(DoneTrigger)
        made.span = new_span(Span, (source, start, ends[at]))
        made.region = region_
        made.final = final_
        return made

    def r_EventTrigger():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        event_ = None
        first = ends[at + 1] - len(token)
        if not (token >= 'A' and token not in SET2): return None
        taken2 = token; at += 1; token = tokens[at]
        text1 = taken2
        if token == '.':
            match3 = REGEX0(text, ends[at + 1] - len(token))
            if match3[0]:
                text1 += match3[0]
                end = match3.end()
                while ends[at] < end: at += 1
                if ends[at] > end: return None
                token = tokens[at]
        value = new_node(Ref)
        value.name = text1
        value.kind = 'Event'
        value.span = new_span(Span, (source, first, first + len(text1)))
        value.target = None
        event_ = value
        made = new_node(EventTrigger)
        made.span = new_span(Span, (source, start, ends[at]))
        made.event = event_
        return made

    def r_Address():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        role_ = None
        index_ = None
        id_ = None
        chosen1 = False
        if not chosen1 and token >= 'A' and token not in SET2:
            before2 = at
            before3 = role_
            before4 = index_
            while True:
                first = ends[at + 1] - len(token)
                taken6 = token; at += 1; token = tokens[at]
                text5 = taken6
                match7 = REGEX12(text, ends[at + 1] - len(token))
                if match7 is None: at = before2; token = tokens[at]; role_ = before3; index_ = before4; break
                end = match7.end()
                while ends[at] < end: at += 1
                if ends[at] > end: at = before2; token = tokens[at]; role_ = before3; index_ = before4; break
                token = tokens[at]
                text5 += match7[0]
                value = new_word(Word, text5)
                value.span = new_span(Span, (source, first, ends[at]))
                role_ = value
                if not (token == '['): at = before2; token = tokens[at]; role_ = before3; index_ = before4; break
                at += 1; token = tokens[at]
                found = expression(at)
                if found is None: at = before2; token = tokens[at]; role_ = before3; index_ = before4; break
                value, at = found; token = tokens[at]
                index_ = value
                if not (token == ']'): at = before2; token = tokens[at]; role_ = before3; index_ = before4; break
                at += 1; token = tokens[at]
                chosen1 = True
                break
        if not chosen1 and token not in SET21:
            before8 = at
            while True:
                found = expression(at)
                if found is None: at = before8; token = tokens[at]; break
                value, at = found; token = tokens[at]
                id_ = value
                chosen1 = True
                break
        if not chosen1: return None
        made = new_node(Address)
        made.span = new_span(Span, (source, start, ends[at]))
        made.role = role_
        made.index = index_
        made.id = id_
        return made

    def try_ImportRos_ImportFile_ImportLibrary():
        nonlocal at, token
        before = at
        made = r_ImportRos()
        if made is not None: return made
        at = before; token = tokens[at]
        made = r_ImportFile()
        if made is not None: return made
        at = before; token = tokens[at]
        return r_ImportLibrary()

    def try_Event_Swarm():
        nonlocal at, token
        before = at
        made = r_Event()
        if made is not None: return made
        at = before; token = tokens[at]
        return r_Swarm()

    def try_CountRange_ParamRange():
        nonlocal at, token
        before = at
        made = r_CountRange()
        if made is not None: return made
        at = before; token = tokens[at]
        return r_ParamRange()

    def try_Setting_ParamRange():
        nonlocal at, token
        before = at
        made = r_Setting()
        if made is not None: return made
        at = before; token = tokens[at]
        return r_ParamRange()

    def try_Role_RobotValues():
        nonlocal at, token
        before = at
        made = r_Role()
        if made is not None: return made
        at = before; token = tokens[at]
        return r_RobotValues()

    def try_DoneTrigger_EventTrigger():
        nonlocal at, token
        before = at
        made = r_DoneTrigger()
        if made is not None: return made
        at = before; token = tokens[at]
        return r_EventTrigger()

    Import_RULES = {'import': try_ImportRos_ImportFile_ImportLibrary}
    Declaration_RULES = {'action': r_ActionType, 'actuator': r_Component, 'const': r_Constant, 'controller': r_Component, 'endless': r_StateMachine, 'enum': r_EnumType, 'environment': r_Environment, 'event': r_Event, 'fitness': r_Fitness, 'function': r_Function, 'member': r_Member, 'message': r_MessageType, 'sensor': r_Component, 'service': r_ServiceType, 'statemachine': r_StateMachine, 'struct': r_StructType, 'swarm': try_Event_Swarm, 'type': r_AliasType, 'virtual': r_Component}
    OptimizationItem_RULES = {'count': try_CountRange_ParamRange, 'evaluations': try_Setting_ParamRange, 'seed': try_Setting_ParamRange, 'steps': try_Setting_ParamRange}
    FunctionItem_RULES = {'action': r_Communication, 'in': r_FunctionPort, 'out': r_FunctionPort, 'param': r_Param, 'service': r_Communication}
    ComponentItem_RULES = {'behavior': r_BehaviorUse, 'in': r_Port, 'inout': r_Port, 'operation': r_Operation, 'out': r_Port, 'param': r_Param}
    MemberItem_RULES = {'behavior': r_BehaviorUse, 'communication': r_CommunicationSettings, 'connect': r_Connector, 'in': r_Port, 'inout': r_Port, 'out': r_Port, 'param': r_Param}
    MachineItem_RULES = {'choice': r_Choice, 'deep': r_History, 'final': r_FinalState, 'history': r_History, 'initial': r_Initial, 'parallel': r_Parallel, 'param': r_Param, 'state': r_State, 'var': r_Variable}
    SwarmItem_RULES = {'environment': r_EnvironmentUse, 'fitness': r_FitnessUse}
    EnvironmentItem_RULES = {'size': r_Size, 'world': r_World}
    FitnessItem_RULES = {'in': r_FitnessInput, 'maximize': r_Objective, 'minimize': r_Objective, 'param': r_Param}
    StateItem_RULES = {'[': r_Transition, 'after': r_Transition, 'choice': r_Choice, 'deep': r_History, 'do': r_Activity, 'entry': r_Entry, 'exit': r_Exit, 'final': r_FinalState, 'history': r_History, 'initial': r_Initial, 'internal': r_Transition, 'monitor': r_Transition, 'on': r_Transition, 'parallel': r_Parallel, 'state': r_State}
    ParallelItem_RULES = {'[': r_Transition, 'after': r_Transition, 'entry': r_Entry, 'exit': r_Exit, 'internal': r_Transition, 'monitor': r_Transition, 'on': r_Transition, 'region': r_Region}
    Effect_RULES = {'(': r_Assignment, '-': r_Assignment, 'event': r_Assignment, 'false': r_Assignment, 'not': r_Assignment, 'self': r_Assignment, 'send': r_Send, 'true': r_Assignment}
    Trigger_RULES = {'aborted': r_OutcomeTrigger, 'done': r_DoneTrigger, 'preempted': r_OutcomeTrigger, 'succeeded': r_OutcomeTrigger}
    RegionItem_RULES = {'choice': r_Choice, 'deep': r_History, 'final': r_FinalState, 'history': r_History, 'initial': r_Initial, 'parallel': r_Parallel, 'state': r_State}

    try:
        model = r_Model()
        if model is None or BLANKS(text, ends[at]).end() < len(text):
            return None
        model.missing_separators = [
            Word(separator, Span(source, ends[at + 1] - len(tokens[at]), ends[at + 1]))
            for at, separator in inline.items()
            if tokens[at - 1] not in SEPARATORS
        ]
        return model, len(expressions.faults)
    finally:
        # They refer to each other: so they are gone at once, without the garbage collector.
        r_Model = r_Package = r_Optimization = r_ImportRos = r_ImportFile = r_ImportLibrary = r_StructType = r_EnumType = r_AliasType = r_Constant = r_MessageType = r_ServiceType = r_ActionType = r_Event = r_Function = r_Component = r_Member = r_StateMachine = r_Swarm = r_Environment = r_Fitness = r_Field = r_TypeRef = r_EnumValue = r_Setting = r_CountRange = r_ParamRange = r_Communication = r_FunctionPort = r_Param = r_Port = r_Operation = r_BehaviorUse = r_CommunicationSettings = r_Connector = r_Part = r_Variable = r_Initial = r_EnvironmentUse = r_FitnessUse = r_Role = r_RobotValues = r_World = r_Size = r_FitnessInput = r_Objective = r_Parameter = r_PartValue = r_PortRef = r_State = r_Parallel = r_Choice = r_History = r_FinalState = r_Multiplicity = r_Argument = r_Branch = r_Activity = r_Entry = r_Exit = r_Transition = r_Region = r_ResultMapping = r_TimeTrigger = r_MonitorTrigger = r_OutcomeTrigger = r_Send = r_Assignment = r_DoneTrigger = r_EventTrigger = r_Address = try_ImportRos_ImportFile_ImportLibrary = try_Event_Swarm = try_CountRange_ParamRange = try_Setting_ParamRange = try_Role_RobotValues = try_DoneTrigger_EventTrigger = Import_RULES = Declaration_RULES = OptimizationItem_RULES = FunctionItem_RULES = ComponentItem_RULES = MemberItem_RULES = MachineItem_RULES = SwarmItem_RULES = EnvironmentItem_RULES = FitnessItem_RULES = StateItem_RULES = ParallelItem_RULES = Effect_RULES = Trigger_RULES = RegionItem_RULES = None

LANGUAGE = Language(LEXER, RESERVED)
# An item may stand after them on one line; the last one is the start of the file.
SEPARATORS = frozenset(("", *"{};,"))
