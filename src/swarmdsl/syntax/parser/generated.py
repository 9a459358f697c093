"""Parses .swarm files: made from grammar/*.tx by `make parser`, not to be edited."""

# mypy: ignore-errors
from __future__ import annotations

import re

from swarmdsl.syntax.parser.expressions import ExpressionParser, TooDeepError
from swarmdsl.syntax.parser.literals import Language, unquoted
from swarmdsl.base.source import Source, Span
from swarmdsl.syntax.ast import Ref, Word, ActionType, Activity, AliasType, Argument, Assignment, BehaviorUse, Branch, Choice, Communication, CommunicationSettings, Component, Connector, Constant, CountRange, DoneTrigger, Entry, EnumType, EnumValue, Environment, EnvironmentUse, Event, EventTrigger, Exit, Field, FinalState, Fitness, FitnessInput, FitnessUse, Function, FunctionPort, History, ImportFile, ImportLibrary, ImportRos, Initial, Member, MessageType, Model, MonitorTrigger, Multiplicity, Objective, Operation, Optimization, OutcomeTrigger, Package, Parallel, Param, ParamRange, Parameter, Part, PartValue, Port, PortRef, Region, ResultMapping, RobotValues, Role, Send, ServiceType, Setting, Size, State, StateMachine, StructType, Swarm, TimeTrigger, Transition, TypeRef, Variable, World
from swarmdsl.syntax.parser.lexer import Lexer

GRAMMAR = 502836344
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
    REGEX8 = re.compile('\\d+\\b', re.MULTILINE).match
    return REGEX8(text, at)


def REGEX9(text, at):
    global REGEX9
    REGEX9 = re.compile('\\d+(?:\\.\\d+)?[ \\t]*(?:km|cm|mm|m)\\b', re.MULTILINE).match
    return REGEX9(text, at)


def REGEX10(text, at):
    global REGEX10
    REGEX10 = re.compile('\\d+\\b|\\*', re.MULTILINE).match
    return REGEX10(text, at)

SET0 = frozenset(['action', 'actuator', 'const', 'controller', 'endless', 'enum', 'environment', 'event', 'fitness', 'function', 'member', 'message', 'optimize', 'sensor', 'service', 'statemachine', 'struct', 'swarm', 'type', 'virtual'])
SET1 = frozenset(['action', 'actuator', 'const', 'controller', 'endless', 'enum', 'environment', 'event', 'fitness', 'function', 'member', 'message', 'sensor', 'service', 'statemachine', 'struct', 'swarm', 'type', 'virtual'])
SET2 = frozenset(['!', '#', '$', '%', '&', "'", '(', ')', '*', '+', ',', '-', '.', '/', ':', ';', '<', '=', '>', '?', '@', '[', '\\', ']', '^', '`', 'aborted', 'action', 'actuator', 'after', 'and', 'behavior', 'choice', 'communication', 'connect', 'const', 'controller', 'do', 'done', 'else', 'endless', 'entry', 'enum', 'environment', 'event', 'exit', 'extends', 'false', 'final', 'fitness', 'function', 'gives', 'history', 'import', 'in', 'initial', 'inout', 'member', 'message', 'monitor', 'not', 'on', 'operation', 'optimize', 'or', 'out', 'package', 'parallel', 'param', 'preempted', 'region', 'self', 'send', 'sensor', 'service', 'state', 'statemachine', 'struct', 'succeeded', 'swarm', 'true', 'type', 'var', 'virtual', '{', '|', '}', '~', '\x7f'])
SET3 = frozenset(['!', '#', '$', '%', '&', "'", '(', ')', '*', '+', ',', '-', '.', '/', ':', ';', '<', '=', '>', '?', '@', '[', '\\', ']', '^', '`', '{', '|', '}', '~', '\x7f'])
SET4 = frozenset(['abstraction', 'swarm'])
SET5 = frozenset(['.', '/'])
SET6 = frozenset(['in', 'out'])
SET7 = frozenset(['[', 'else'])
SET8 = frozenset(['after', 'monitor', 'on'])
RESERVED = frozenset(['aborted', 'action', 'actuator', 'after', 'and', 'behavior', 'choice', 'communication', 'connect', 'const', 'controller', 'do', 'done', 'else', 'endless', 'entry', 'enum', 'environment', 'event', 'exit', 'extends', 'false', 'final', 'fitness', 'function', 'gives', 'history', 'import', 'in', 'initial', 'inout', 'member', 'message', 'monitor', 'not', 'on', 'operation', 'optimize', 'or', 'out', 'package', 'parallel', 'param', 'preempted', 'region', 'self', 'send', 'sensor', 'service', 'state', 'statemachine', 'struct', 'succeeded', 'swarm', 'true', 'type', 'var', 'virtual'])
TERMINALS = (
    ('\\Z', 'EOF', ''),
    ('package\\b', '', 'package'),
    ('optimize\\b', '', 'optimize'),
    ('\\{', '', '{'),
    ('\\}', '', '}'),
    ('import\\b', '', 'import'),
    ('ros\\b', '', 'ros'),
    ('struct\\b', '', 'struct'),
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
    (',', '', ','),
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
    ('send\\b', '', 'send'),
    ('done\\b', '', 'done'),
    ('succeeded\\b', '', 'succeeded'),
    ('aborted\\b', '', 'aborted'),
    ('preempted\\b', '', 'preempted'),
)
PROGRAM = (
    (3, 3),
    (0, 0),
    (5, 0),
    (1, 6),
    (3, 22),
    (2, 6),
    (1, 9),
    (3, 25),
    (2, 6),
    (1, 21),
    (1, 16),
    (3, 33),
    (1, 15),
    (3, 33),
    (2, 12),
    (2, 20),
    (3, 77),
    (1, 20),
    (3, 77),
    (2, 17),
    (2, 9),
    (4, 0),
    (0, 1),
    (3, 85),
    (4, 0),
    (1, 28),
    (3, 87),
    (2, 32),
    (1, 31),
    (3, 91),
    (2, 32),
    (3, 94),
    (4, 0),
    (1, 36),
    (3, 97),
    (2, 76),
    (1, 39),
    (3, 105),
    (2, 76),
    (1, 42),
    (3, 117),
    (2, 76),
    (1, 45),
    (3, 122),
    (2, 76),
    (1, 48),
    (3, 129),
    (2, 76),
    (1, 51),
    (3, 146),
    (2, 76),
    (1, 54),
    (3, 167),
    (2, 76),
    (1, 57),
    (3, 196),
    (2, 76),
    (1, 60),
    (3, 208),
    (2, 76),
    (1, 63),
    (3, 218),
    (2, 76),
    (1, 66),
    (3, 230),
    (2, 76),
    (1, 69),
    (3, 242),
    (2, 76),
    (1, 72),
    (3, 253),
    (2, 76),
    (1, 75),
    (3, 261),
    (2, 76),
    (3, 269),
    (4, 0),
    (0, 2),
    (3, 277),
    (0, 3),
    (1, 83),
    (3, 280),
    (2, 80),
    (0, 4),
    (4, 0),
    (3, 277),
    (4, 0),
    (0, 5),
    (0, 6),
    (3, 288),
    (4, 0),
    (0, 5),
    (3, 288),
    (4, 0),
    (0, 5),
    (3, 290),
    (4, 0),
    (0, 7),
    (3, 293),
    (0, 3),
    (1, 103),
    (3, 295),
    (2, 100),
    (0, 4),
    (4, 0),
    (0, 8),
    (3, 293),
    (1, 111),
    (0, 9),
    (3, 299),
    (2, 111),
    (0, 3),
    (1, 115),
    (3, 307),
    (2, 112),
    (0, 4),
    (4, 0),
    (0, 10),
    (3, 293),
    (0, 11),
    (3, 299),
    (4, 0),
    (0, 12),
    (3, 293),
    (0, 9),
    (3, 299),
    (0, 11),
    (3, 313),
    (4, 0),
    (0, 13),
    (3, 315),
    (0, 3),
    (1, 144),
    (1, 139),
    (3, 122),
    (1, 138),
    (3, 122),
    (2, 135),
    (2, 143),
    (3, 295),
    (1, 143),
    (3, 295),
    (2, 140),
    (2, 132),
    (0, 4),
    (4, 0),
    (0, 14),
    (3, 315),
    (0, 3),
    (1, 157),
    (0, 15),
    (0, 3),
    (1, 155),
    (3, 295),
    (2, 152),
    (0, 4),
    (2, 157),
    (1, 165),
    (0, 16),
    (0, 3),
    (1, 163),
    (3, 295),
    (2, 160),
    (0, 4),
    (2, 165),
    (0, 4),
    (4, 0),
    (0, 17),
    (3, 315),
    (0, 3),
    (1, 178),
    (0, 18),
    (0, 3),
    (1, 176),
    (3, 295),
    (2, 173),
    (0, 4),
    (2, 178),
    (1, 186),
    (0, 19),
    (0, 3),
    (1, 184),
    (3, 295),
    (2, 181),
    (0, 4),
    (2, 186),
    (1, 194),
    (0, 20),
    (0, 3),
    (1, 192),
    (3, 295),
    (2, 189),
    (0, 4),
    (2, 194),
    (0, 4),
    (4, 0),
    (1, 199),
    (0, 21),
    (2, 199),
    (0, 22),
    (3, 293),
    (0, 9),
    (3, 299),
    (1, 207),
    (0, 23),
    (3, 288),
    (2, 207),
    (4, 0),
    (0, 24),
    (3, 293),
    (0, 9),
    (3, 317),
    (0, 3),
    (1, 216),
    (3, 322),
    (2, 213),
    (0, 4),
    (4, 0),
    (3, 330),
    (3, 293),
    (1, 224),
    (0, 25),
    (3, 277),
    (2, 224),
    (0, 3),
    (1, 228),
    (3, 341),
    (2, 225),
    (0, 4),
    (4, 0),
    (0, 26),
    (3, 293),
    (1, 236),
    (0, 25),
    (3, 277),
    (2, 236),
    (0, 3),
    (1, 240),
    (3, 352),
    (2, 237),
    (0, 4),
    (4, 0),
    (1, 245),
    (0, 27),
    (2, 245),
    (0, 28),
    (3, 293),
    (0, 3),
    (1, 251),
    (3, 369),
    (2, 248),
    (0, 4),
    (4, 0),
    (0, 21),
    (3, 293),
    (0, 3),
    (1, 259),
    (3, 380),
    (2, 256),
    (0, 4),
    (4, 0),
    (0, 29),
    (3, 293),
    (0, 3),
    (1, 267),
    (3, 391),
    (2, 264),
    (0, 4),
    (4, 0),
    (0, 30),
    (3, 293),
    (0, 3),
    (1, 275),
    (3, 396),
    (2, 272),
    (0, 4),
    (4, 0),
    (3, 404),
    (0, 31),
    (4, 0),
    (1, 283),
    (3, 406),
    (2, 287),
    (1, 286),
    (3, 409),
    (2, 287),
    (3, 417),
    (4, 0),
    (3, 429),
    (4, 0),
    (3, 404),
    (0, 32),
    (4, 0),
    (3, 404),
    (4, 0),
    (3, 431),
    (0, 9),
    (3, 299),
    (4, 0),
    (3, 433),
    (1, 303),
    (3, 436),
    (2, 303),
    (1, 306),
    (3, 438),
    (2, 306),
    (4, 0),
    (3, 293),
    (1, 312),
    (0, 11),
    (3, 440),
    (2, 312),
    (4, 0),
    (3, 442),
    (4, 0),
    (3, 448),
    (4, 0),
    (1, 320),
    (0, 33),
    (2, 321),
    (0, 21),
    (4, 0),
    (1, 325),
    (3, 451),
    (2, 329),
    (1, 328),
    (3, 456),
    (2, 329),
    (3, 461),
    (4, 0),
    (1, 333),
    (0, 34),
    (2, 340),
    (1, 336),
    (0, 35),
    (2, 340),
    (1, 339),
    (0, 36),
    (2, 340),
    (0, 37),
    (4, 0),
    (1, 344),
    (3, 470),
    (2, 351),
    (1, 347),
    (3, 461),
    (2, 351),
    (1, 350),
    (3, 479),
    (2, 351),
    (3, 491),
    (4, 0),
    (1, 355),
    (3, 491),
    (2, 368),
    (1, 358),
    (3, 494),
    (2, 368),
    (1, 361),
    (3, 470),
    (2, 368),
    (1, 364),
    (3, 461),
    (2, 368),
    (1, 367),
    (3, 502),
    (2, 368),
    (3, 507),
    (4, 0),
    (1, 372),
    (3, 461),
    (2, 379),
    (1, 375),
    (3, 518),
    (2, 379),
    (1, 378),
    (3, 527),
    (2, 379),
    (3, 530),
    (4, 0),
    (1, 383),
    (3, 544),
    (2, 390),
    (1, 386),
    (3, 547),
    (2, 390),
    (1, 389),
    (3, 550),
    (2, 390),
    (3, 566),
    (4, 0),
    (1, 394),
    (3, 576),
    (2, 395),
    (3, 579),
    (4, 0),
    (1, 399),
    (3, 588),
    (2, 403),
    (1, 402),
    (3, 461),
    (2, 403),
    (3, 593),
    (4, 0),
    (0, 38),
    (4, 0),
    (3, 596),
    (3, 313),
    (4, 0),
    (0, 39),
    (0, 40),
    (3, 404),
    (0, 41),
    (3, 313),
    (0, 42),
    (3, 313),
    (4, 0),
    (3, 404),
    (0, 43),
    (3, 404),
    (0, 41),
    (3, 313),
    (0, 42),
    (3, 313),
    (1, 428),
    (0, 44),
    (3, 313),
    (2, 428),
    (4, 0),
    (0, 45),
    (4, 0),
    (3, 604),
    (4, 0),
    (3, 404),
    (0, 46),
    (4, 0),
    (0, 47),
    (4, 0),
    (0, 48),
    (4, 0),
    (0, 49),
    (4, 0),
    (3, 606),
    (1, 447),
    (3, 611),
    (3, 606),
    (2, 443),
    (4, 0),
    (3, 404),
    (0, 50),
    (4, 0),
    (3, 649),
    (3, 288),
    (0, 9),
    (3, 299),
    (4, 0),
    (3, 654),
    (3, 288),
    (0, 9),
    (3, 299),
    (4, 0),
    (0, 51),
    (3, 293),
    (0, 9),
    (3, 299),
    (1, 469),
    (0, 11),
    (3, 313),
    (2, 469),
    (4, 0),
    (3, 659),
    (3, 293),
    (0, 9),
    (3, 299),
    (1, 478),
    (0, 23),
    (3, 288),
    (2, 478),
    (4, 0),
    (0, 52),
    (3, 293),
    (0, 53),
    (1, 489),
    (3, 667),
    (1, 488),
    (0, 54),
    (3, 667),
    (2, 484),
    (2, 489),
    (0, 55),
    (4, 0),
    (0, 56),
    (3, 277),
    (4, 0),
    (0, 57),
    (3, 293),
    (0, 3),
    (1, 500),
    (3, 675),
    (2, 497),
    (0, 4),
    (4, 0),
    (0, 58),
    (3, 679),
    (0, 59),
    (3, 679),
    (4, 0),
    (3, 293),
    (0, 9),
    (3, 277),
    (1, 517),
    (0, 3),
    (1, 515),
    (3, 675),
    (2, 512),
    (0, 4),
    (2, 517),
    (4, 0),
    (0, 60),
    (3, 293),
    (0, 9),
    (3, 299),
    (1, 526),
    (0, 11),
    (3, 313),
    (2, 526),
    (4, 0),
    (0, 61),
    (3, 277),
    (4, 0),
    (1, 533),
    (3, 685),
    (2, 543),
    (1, 536),
    (3, 710),
    (2, 543),
    (1, 539),
    (3, 719),
    (2, 543),
    (1, 542),
    (3, 727),
    (2, 543),
    (3, 735),
    (4, 0),
    (0, 29),
    (3, 277),
    (4, 0),
    (0, 30),
    (3, 277),
    (4, 0),
    (3, 293),
    (0, 9),
    (3, 277),
    (1, 558),
    (0, 62),
    (3, 738),
    (0, 63),
    (2, 558),
    (1, 565),
    (0, 3),
    (1, 563),
    (3, 675),
    (2, 560),
    (0, 4),
    (2, 565),
    (4, 0),
    (3, 404),
    (0, 62),
    (3, 744),
    (0, 63),
    (0, 3),
    (1, 574),
    (3, 675),
    (2, 571),
    (0, 4),
    (4, 0),
    (0, 64),
    (3, 288),
    (4, 0),
    (0, 65),
    (3, 746),
    (0, 66),
    (3, 746),
    (1, 587),
    (0, 66),
    (3, 746),
    (2, 587),
    (4, 0),
    (0, 41),
    (3, 293),
    (0, 9),
    (3, 299),
    (4, 0),
    (3, 748),
    (3, 313),
    (4, 0),
    (1, 599),
    (0, 67),
    (2, 603),
    (1, 602),
    (0, 68),
    (2, 603),
    (0, 69),
    (4, 0),
    (0, 70),
    (4, 0),
    (1, 609),
    (3, 753),
    (2, 606),
    (3, 758),
    (4, 0),
    (1, 614),
    (0, 71),
    (2, 648),
    (1, 617),
    (0, 72),
    (2, 648),
    (1, 620),
    (0, 73),
    (2, 648),
    (1, 623),
    (0, 74),
    (2, 648),
    (1, 626),
    (0, 75),
    (2, 648),
    (1, 629),
    (0, 76),
    (2, 648),
    (1, 632),
    (0, 77),
    (2, 648),
    (1, 635),
    (0, 78),
    (2, 648),
    (1, 638),
    (0, 79),
    (2, 648),
    (1, 641),
    (3, 780),
    (2, 648),
    (1, 644),
    (0, 80),
    (2, 648),
    (1, 647),
    (0, 81),
    (2, 648),
    (0, 82),
    (4, 0),
    (1, 652),
    (0, 17),
    (2, 653),
    (0, 14),
    (4, 0),
    (1, 657),
    (0, 41),
    (2, 658),
    (0, 83),
    (4, 0),
    (1, 662),
    (0, 84),
    (2, 666),
    (1, 665),
    (0, 41),
    (2, 666),
    (0, 83),
    (4, 0),
    (1, 671),
    (3, 654),
    (3, 431),
    (2, 672),
    (3, 431),
    (0, 9),
    (3, 299),
    (4, 0),
    (3, 431),
    (0, 11),
    (3, 313),
    (4, 0),
    (1, 683),
    (3, 404),
    (0, 43),
    (2, 683),
    (3, 404),
    (4, 0),
    (0, 85),
    (3, 293),
    (1, 702),
    (0, 11),
    (3, 277),
    (1, 701),
    (0, 53),
    (1, 699),
    (3, 782),
    (1, 698),
    (0, 54),
    (3, 782),
    (2, 694),
    (2, 699),
    (0, 55),
    (2, 701),
    (2, 702),
    (1, 709),
    (0, 3),
    (1, 707),
    (3, 786),
    (2, 704),
    (0, 4),
    (2, 709),
    (4, 0),
    (0, 86),
    (0, 85),
    (3, 293),
    (0, 3),
    (1, 717),
    (3, 803),
    (2, 714),
    (0, 4),
    (4, 0),
    (0, 87),
    (3, 293),
    (0, 3),
    (1, 725),
    (3, 814),
    (2, 722),
    (0, 4),
    (4, 0),
    (1, 730),
    (0, 88),
    (2, 730),
    (0, 89),
    (3, 293),
    (0, 59),
    (3, 277),
    (4, 0),
    (0, 90),
    (3, 293),
    (4, 0),
    (3, 831),
    (1, 743),
    (0, 42),
    (3, 831),
    (2, 743),
    (4, 0),
    (0, 91),
    (4, 0),
    (0, 92),
    (4, 0),
    (1, 751),
    (0, 93),
    (2, 752),
    (0, 94),
    (4, 0),
    (1, 756),
    (0, 95),
    (2, 757),
    (3, 780),
    (4, 0),
    (1, 761),
    (3, 833),
    (2, 779),
    (1, 764),
    (3, 429),
    (2, 779),
    (1, 767),
    (0, 96),
    (2, 779),
    (1, 770),
    (0, 97),
    (2, 779),
    (1, 773),
    (3, 835),
    (2, 779),
    (1, 776),
    (3, 846),
    (2, 779),
    (0, 53),
    (3, 442),
    (0, 55),
    (4, 0),
    (0, 98),
    (4, 0),
    (3, 431),
    (0, 11),
    (3, 313),
    (4, 0),
    (1, 789),
    (3, 852),
    (2, 802),
    (1, 792),
    (3, 884),
    (2, 802),
    (1, 795),
    (3, 892),
    (2, 802),
    (1, 798),
    (3, 900),
    (2, 802),
    (1, 801),
    (3, 527),
    (2, 802),
    (3, 530),
    (4, 0),
    (1, 806),
    (3, 958),
    (2, 813),
    (1, 809),
    (3, 884),
    (2, 813),
    (1, 812),
    (3, 892),
    (2, 813),
    (3, 900),
    (4, 0),
    (1, 819),
    (0, 62),
    (3, 313),
    (0, 63),
    (2, 820),
    (0, 99),
    (1, 828),
    (0, 81),
    (3, 966),
    (1, 827),
    (0, 54),
    (3, 966),
    (2, 823),
    (2, 828),
    (0, 59),
    (3, 277),
    (4, 0),
    (0, 100),
    (4, 0),
    (0, 101),
    (4, 0),
    (3, 404),
    (0, 53),
    (1, 844),
    (3, 442),
    (1, 843),
    (0, 54),
    (3, 442),
    (2, 839),
    (2, 844),
    (0, 55),
    (4, 0),
    (3, 971),
    (1, 851),
    (0, 43),
    (3, 604),
    (2, 847),
    (4, 0),
    (0, 102),
    (3, 277),
    (1, 869),
    (0, 53),
    (1, 860),
    (0, 103),
    (3, 293),
    (2, 867),
    (1, 867),
    (3, 782),
    (1, 866),
    (0, 54),
    (3, 782),
    (2, 862),
    (2, 867),
    (0, 55),
    (2, 869),
    (1, 883),
    (0, 104),
    (1, 875),
    (0, 103),
    (3, 293),
    (2, 882),
    (0, 53),
    (3, 979),
    (1, 881),
    (0, 54),
    (3, 979),
    (2, 877),
    (0, 55),
    (2, 883),
    (4, 0),
    (0, 105),
    (0, 81),
    (3, 966),
    (1, 891),
    (0, 54),
    (3, 966),
    (2, 887),
    (4, 0),
    (0, 106),
    (0, 81),
    (3, 966),
    (1, 899),
    (0, 54),
    (3, 966),
    (2, 895),
    (4, 0),
    (1, 903),
    (0, 107),
    (2, 903),
    (1, 944),
    (1, 912),
    (0, 23),
    (3, 983),
    (1, 911),
    (0, 54),
    (3, 983),
    (2, 907),
    (2, 924),
    (1, 919),
    (3, 991),
    (1, 918),
    (0, 54),
    (3, 991),
    (2, 914),
    (2, 924),
    (3, 994),
    (1, 924),
    (0, 54),
    (3, 994),
    (2, 920),
    (1, 929),
    (0, 62),
    (3, 313),
    (0, 63),
    (2, 929),
    (1, 941),
    (0, 81),
    (3, 966),
    (1, 936),
    (0, 54),
    (3, 966),
    (2, 932),
    (1, 940),
    (0, 59),
    (3, 277),
    (2, 940),
    (2, 943),
    (0, 59),
    (3, 277),
    (2, 957),
    (0, 62),
    (3, 313),
    (0, 63),
    (1, 955),
    (0, 81),
    (3, 966),
    (1, 954),
    (0, 54),
    (3, 966),
    (2, 950),
    (2, 955),
    (0, 59),
    (3, 277),
    (4, 0),
    (0, 108),
    (3, 293),
    (0, 3),
    (1, 964),
    (3, 999),
    (2, 961),
    (0, 4),
    (4, 0),
    (1, 969),
    (3, 1004),
    (2, 970),
    (3, 1018),
    (4, 0),
    (1, 974),
    (0, 22),
    (2, 978),
    (1, 977),
    (0, 109),
    (2, 978),
    (3, 404),
    (4, 0),
    (3, 431),
    (0, 110),
    (3, 1022),
    (4, 0),
    (1, 986),
    (3, 1024),
    (2, 990),
    (1, 989),
    (3, 1026),
    (2, 990),
    (3, 1036),
    (4, 0),
    (0, 111),
    (3, 1038),
    (4, 0),
    (0, 112),
    (3, 288),
    (0, 9),
    (3, 299),
    (4, 0),
    (1, 1002),
    (3, 527),
    (2, 1003),
    (3, 530),
    (4, 0),
    (0, 113),
    (3, 277),
    (1, 1017),
    (0, 53),
    (1, 1015),
    (3, 782),
    (1, 1014),
    (0, 54),
    (3, 782),
    (2, 1010),
    (2, 1015),
    (0, 55),
    (2, 1017),
    (4, 0),
    (3, 1022),
    (0, 11),
    (3, 313),
    (4, 0),
    (3, 606),
    (4, 0),
    (3, 1040),
    (4, 0),
    (1, 1030),
    (3, 404),
    (0, 43),
    (2, 1030),
    (0, 114),
    (1, 1035),
    (0, 43),
    (3, 404),
    (2, 1035),
    (4, 0),
    (3, 277),
    (4, 0),
    (3, 1048),
    (4, 0),
    (1, 1043),
    (0, 115),
    (2, 1047),
    (1, 1046),
    (0, 116),
    (2, 1047),
    (0, 117),
    (4, 0),
    (3, 606),
    (1, 1053),
    (3, 1054),
    (3, 606),
    (2, 1049),
    (4, 0),
    (1, 1057),
    (0, 79),
    (2, 1061),
    (1, 1060),
    (3, 780),
    (2, 1061),
    (0, 80),
    (4, 0),
)


def parse(source: Source, docs: dict[int, str], limit: int) -> tuple[Model, int] | None:
    """Parse a file to a model; None where it does not follow the grammar.

    With the model comes how many expressions are wrong: they have no trees. Documentation
    is taken from `docs`, which maps places to texts. Raises TooDeepError for nesting beyond
    `limit`.
    """
    text = source.text
    depth = at = 0
    tokens, ends = LEXER.tokenize(text)
    token = tokens[0]
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
            while True:
                value = r_Package()
                if value is None: at = before1; token = tokens[at]; break
                package_ = value
                break
        while True:
            before2 = at
            rule = Import_RULES.get(token)
            if rule is None: at = before2; token = tokens[at]; break
            value = rule()
            if value is None: at = before2; token = tokens[at]; break
            imports_.append(value)
        while token in SET0:
            before3 = at
            before4 = len(declarations_)
            before5 = len(optimizations_)
            if token in SET1:
                rule = Declaration_RULES.get(token)
                if rule is None: at = before3; token = tokens[at]; del declarations_[before4:]; del optimizations_[before5:]; break
                value = rule()
                if value is None: at = before3; token = tokens[at]; del declarations_[before4:]; del optimizations_[before5:]; break
                declarations_.append(value)
                while True:
                    before6 = at
                    rule = Declaration_RULES.get(token)
                    if rule is None: at = before6; token = tokens[at]; break
                    value = rule()
                    if value is None: at = before6; token = tokens[at]; break
                    declarations_.append(value)
            elif token == 'optimize':
                value = r_Optimization()
                if value is None: at = before3; token = tokens[at]; del declarations_[before4:]; del optimizations_[before5:]; break
                optimizations_.append(value)
                while token == 'optimize':
                    before7 = at
                    value = r_Optimization()
                    if value is None: at = before7; token = tokens[at]; break
                    optimizations_.append(value)
            else: at = before3; token = tokens[at]; del declarations_[before4:]; del optimizations_[before5:]; break
        made = new_node(Model)
        made.span = new_span(Span, (source, start, ends[at]))
        made.package = package_
        made.imports = imports_
        made.declarations = declarations_
        made.optimizations = optimizations_
        return made

    def r_Package():
        nonlocal at, token
        start = ends[at + 1] - 7
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
        while True:
            before4 = at
            rule = OptimizationItem_RULES.get(token, r_ParamRange)
            value = rule()
            if value is None: at = before4; token = tokens[at]; break
            items_.append(value)
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
            value = r_Field()
            if value is None: at = before2; token = tokens[at]; break
            fields_.append(value)
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
            value = r_EnumValue()
            if value is None: at = before4; token = tokens[at]; break
            values_.append(value)
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
                    value = r_Field()
                    if value is None: at = before6; token = tokens[at]; break
                    request_.append(value)
                if not (token == '}'): at = before4; token = tokens[at]; del request_[before5:]; break
                at += 1; token = tokens[at]
                break
        if token == 'response':
            before7 = at
            before8 = len(response_)
            while True:
                at += 1; token = tokens[at]
                if not (token == '{'): at = before7; token = tokens[at]; del response_[before8:]; break
                at += 1; token = tokens[at]
                while token >= 'A' and token not in SET3:
                    before9 = at
                    value = r_Field()
                    if value is None: at = before9; token = tokens[at]; break
                    response_.append(value)
                if not (token == '}'): at = before7; token = tokens[at]; del response_[before8:]; break
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
                    value = r_Field()
                    if value is None: at = before6; token = tokens[at]; break
                    goal_.append(value)
                if not (token == '}'): at = before4; token = tokens[at]; del goal_[before5:]; break
                at += 1; token = tokens[at]
                break
        if token == 'result':
            before7 = at
            before8 = len(result_)
            while True:
                at += 1; token = tokens[at]
                if not (token == '{'): at = before7; token = tokens[at]; del result_[before8:]; break
                at += 1; token = tokens[at]
                while token >= 'A' and token not in SET3:
                    before9 = at
                    value = r_Field()
                    if value is None: at = before9; token = tokens[at]; break
                    result_.append(value)
                if not (token == '}'): at = before7; token = tokens[at]; del result_[before8:]; break
                at += 1; token = tokens[at]
                break
        if token == 'feedback':
            before10 = at
            before11 = len(feedback_)
            while True:
                at += 1; token = tokens[at]
                if not (token == '{'): at = before10; token = tokens[at]; del feedback_[before11:]; break
                at += 1; token = tokens[at]
                while token >= 'A' and token not in SET3:
                    before12 = at
                    value = r_Field()
                    if value is None: at = before12; token = tokens[at]; break
                    feedback_.append(value)
                if not (token == '}'): at = before10; token = tokens[at]; del feedback_[before11:]; break
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
        if not (token in SET4): return None
        taken2 = token; at += 1; token = tokens[at]
        category_ = taken2
        if not (token == '{'): return None
        at += 1; token = tokens[at]
        while True:
            before3 = at
            rule = FunctionItem_RULES.get(token)
            if rule is None: at = before3; token = tokens[at]; break
            value = rule()
            if value is None: at = before3; token = tokens[at]; break
            items_.append(value)
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
        while True:
            before8 = at
            rule = ComponentItem_RULES.get(token)
            if rule is None: at = before8; token = tokens[at]; break
            value = rule()
            if value is None: at = before8; token = tokens[at]; break
            items_.append(value)
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
        while True:
            before7 = at
            rule = MemberItem_RULES.get(token, r_Part)
            value = rule()
            if value is None: at = before7; token = tokens[at]; break
            items_.append(value)
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
        while True:
            before2 = at
            rule = MachineItem_RULES.get(token)
            if rule is None: at = before2; token = tokens[at]; break
            value = rule()
            if value is None: at = before2; token = tokens[at]; break
            items_.append(value)
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
        while True:
            before2 = at
            rule = SwarmItem_RULES.get(token, try_Role_RobotValues)
            value = rule()
            if value is None: at = before2; token = tokens[at]; break
            items_.append(value)
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
        while True:
            before2 = at
            rule = EnvironmentItem_RULES.get(token)
            if rule is None: at = before2; token = tokens[at]; break
            value = rule()
            if value is None: at = before2; token = tokens[at]; break
            items_.append(value)
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
        while True:
            before2 = at
            rule = FitnessItem_RULES.get(token)
            if rule is None: at = before2; token = tokens[at]; break
            value = rule()
            if value is None: at = before2; token = tokens[at]; break
            items_.append(value)
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
        if token in SET5:
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
        direction_ = None
        name_ = None
        type_ = None
        topic_ = None
        taken1 = token; at += 1; token = tokens[at]
        direction_ = taken1
        if not (token >= 'A' and token not in SET2): return None
        taken2 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken2)
        value.span = new_span(Span, (source, ends[at] - len(taken2), ends[at]))
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
            value = r_PartValue()
            if value is None: at = before2; token = tokens[at]; break
            values_.append(value)
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
                    value = r_PartValue()
                    if value is None: at = before7; token = tokens[at]; break
                    values_.append(value)
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
                    value = r_PartValue()
                    if value is None: at = before9; token = tokens[at]; break
                    values_.append(value)
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
        match2 = REGEX8(text, ends[at + 1] - len(token))
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
            value = r_PartValue()
            if value is None: at = before3; token = tokens[at]; break
            values_.append(value)
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
        width_ = None
        depth_ = None
        height_ = None
        at += 1; token = tokens[at]
        match1 = REGEX9(text, ends[at + 1] - len(token))
        if match1 is None: return None
        end = match1.end()
        while ends[at] < end: at += 1
        if ends[at] > end: return None
        token = tokens[at]
        width_ = match1[0]
        if not (token == 'x'): return None
        at += 1; token = tokens[at]
        match2 = REGEX9(text, ends[at + 1] - len(token))
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
                match5 = REGEX9(text, ends[at + 1] - len(token))
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
        if not chosen1 and token in SET6:
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
        if not (token >= 'A' and token not in SET2): return None
        taken4 = token; at += 1; token = tokens[at]
        value = new_node(Ref)
        value.name = taken4
        value.kind = 'Port'
        value.span = new_span(Span, (source, ends[at] - len(taken4), ends[at]))
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
                while True:
                    before14 = at
                    rule = StateItem_RULES.get(token)
                    if rule is None: at = before14; token = tokens[at]; break
                    value = rule()
                    if value is None: at = before14; token = tokens[at]; break
                    items_.append(value)
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
        while True:
            before2 = at
            rule = ParallelItem_RULES.get(token)
            if rule is None: at = before2; token = tokens[at]; break
            value = rule()
            if value is None: at = before2; token = tokens[at]; break
            items_.append(value)
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
        while token in SET7:
            before2 = at
            value = r_Branch()
            if value is None: at = before2; token = tokens[at]; break
            branches_.append(value)
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
        if not (token == '-' and tokens[at + 1] == '>' and ends[at + 2] == ends[at + 1] + 1): return None
        at += 2; token = tokens[at]
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
        value.kind = 'Vertex'
        value.span = new_span(Span, (source, first, first + len(text2)))
        value.target = None
        target_ = value
        made = new_node(History)
        made.span = new_span(Span, (source, start, ends[at]))
        made.deep = deep_
        made.name = name_
        made.target = target_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_FinalState():
        nonlocal at, token
        start = ends[at + 1] - 5
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
        match1 = REGEX10(text, ends[at + 1] - len(token))
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
                match4 = REGEX10(text, ends[at + 1] - len(token))
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
        internal_ = False
        triggers_ = []
        guard_ = None
        effects_ = []
        target_ = None
        if token == 'internal':
            at += 1; token = tokens[at]
            internal_ = True
        if token in SET8:
            if token == 'on':
                at += 1; token = tokens[at]
                rule = Trigger_RULES.get(token, try_DoneTrigger_EventTrigger)
                value = rule()
                if value is None: return None
                triggers_.append(value)
                while token == ',':
                    before1 = at
                    at += 1; token = tokens[at]
                    rule = Trigger_RULES.get(token, try_DoneTrigger_EventTrigger)
                    value = rule()
                    if value is None: at = before1; token = tokens[at]; break
                    triggers_.append(value)
            elif token == 'after':
                value = r_TimeTrigger()
                if value is None: return None
                triggers_.append(value)
                while token == ',':
                    before2 = at
                    at += 1; token = tokens[at]
                    if not (token == 'after'): at = before2; token = tokens[at]; break
                    value = r_TimeTrigger()
                    if value is None: at = before2; token = tokens[at]; break
                    triggers_.append(value)
            elif token == 'monitor':
                value = r_MonitorTrigger()
                if value is None: return None
                triggers_.append(value)
                while token == ',':
                    before3 = at
                    at += 1; token = tokens[at]
                    if not (token == 'monitor'): at = before3; token = tokens[at]; break
                    value = r_MonitorTrigger()
                    if value is None: at = before3; token = tokens[at]; break
                    triggers_.append(value)
            else: return None
            if token == '[':
                before4 = at
                before5 = guard_
                while True:
                    at += 1; token = tokens[at]
                    found = expression(at)
                    if found is None: at = before4; token = tokens[at]; guard_ = before5; break
                    value, at = found; token = tokens[at]
                    guard_ = value
                    if not (token == ']'): at = before4; token = tokens[at]; guard_ = before5; break
                    at += 1; token = tokens[at]
                    break
            if token == '/':
                at += 1; token = tokens[at]
                rule = Effect_RULES.get(token, r_Assignment)
                value = rule()
                if value is None: return None
                effects_.append(value)
                while token == ',':
                    before6 = at
                    at += 1; token = tokens[at]
                    rule = Effect_RULES.get(token, r_Assignment)
                    value = rule()
                    if value is None: at = before6; token = tokens[at]; break
                    effects_.append(value)
                if token == '-':
                    before7 = at
                    before8 = target_
                    while True:
                        if not (token == '-' and tokens[at + 1] == '>' and ends[at + 2] == ends[at + 1] + 1): at = before7; token = tokens[at]; target_ = before8; break
                        at += 2; token = tokens[at]
                        first = ends[at + 1] - len(token)
                        if not (token >= 'A' and token not in SET2): at = before7; token = tokens[at]; target_ = before8; break
                        taken10 = token; at += 1; token = tokens[at]
                        text9 = taken10
                        if token == '.':
                            match11 = REGEX0(text, ends[at + 1] - len(token))
                            if match11[0]:
                                text9 += match11[0]
                                end = match11.end()
                                while ends[at] < end: at += 1
                                if ends[at] > end: at = before7; token = tokens[at]; target_ = before8; break
                                token = tokens[at]
                        value = new_node(Ref)
                        value.name = text9
                        value.kind = 'Vertex'
                        value.span = new_span(Span, (source, first, first + len(text9)))
                        value.target = None
                        target_ = value
                        break
            elif token == '-':
                if not (token == '-' and tokens[at + 1] == '>' and ends[at + 2] == ends[at + 1] + 1): return None
                at += 2; token = tokens[at]
                first = ends[at + 1] - len(token)
                if not (token >= 'A' and token not in SET2): return None
                taken13 = token; at += 1; token = tokens[at]
                text12 = taken13
                if token == '.':
                    match14 = REGEX0(text, ends[at + 1] - len(token))
                    if match14[0]:
                        text12 += match14[0]
                        end = match14.end()
                        while ends[at] < end: at += 1
                        if ends[at] > end: return None
                        token = tokens[at]
                value = new_node(Ref)
                value.name = text12
                value.kind = 'Vertex'
                value.span = new_span(Span, (source, first, first + len(text12)))
                value.target = None
                target_ = value
            else: return None
        elif token == '[':
            at += 1; token = tokens[at]
            found = expression(at)
            if found is None: return None
            value, at = found; token = tokens[at]
            guard_ = value
            if not (token == ']'): return None
            at += 1; token = tokens[at]
            if token == '/':
                before15 = at
                before16 = len(effects_)
                while True:
                    at += 1; token = tokens[at]
                    rule = Effect_RULES.get(token, r_Assignment)
                    value = rule()
                    if value is None: at = before15; token = tokens[at]; del effects_[before16:]; break
                    effects_.append(value)
                    while token == ',':
                        before17 = at
                        at += 1; token = tokens[at]
                        rule = Effect_RULES.get(token, r_Assignment)
                        value = rule()
                        if value is None: at = before17; token = tokens[at]; break
                        effects_.append(value)
                    break
            if not (token == '-' and tokens[at + 1] == '>' and ends[at + 2] == ends[at + 1] + 1): return None
            at += 2; token = tokens[at]
            first = ends[at + 1] - len(token)
            if not (token >= 'A' and token not in SET2): return None
            taken19 = token; at += 1; token = tokens[at]
            text18 = taken19
            if token == '.':
                match20 = REGEX0(text, ends[at + 1] - len(token))
                if match20[0]:
                    text18 += match20[0]
                    end = match20.end()
                    while ends[at] < end: at += 1
                    if ends[at] > end: return None
                    token = tokens[at]
            value = new_node(Ref)
            value.name = text18
            value.kind = 'Vertex'
            value.span = new_span(Span, (source, first, first + len(text18)))
            value.target = None
            target_ = value
        else: return None
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
        while True:
            before2 = at
            rule = RegionItem_RULES.get(token)
            if rule is None: at = before2; token = tokens[at]; break
            value = rule()
            if value is None: at = before2; token = tokens[at]; break
            items_.append(value)
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
        made = new_node(MonitorTrigger)
        made.span = new_span(Span, (source, start, ends[at]))
        made.topic = topic_
        made.type = type_
        return made

    def r_Send():
        nonlocal at, token
        start = ends[at + 1] - 4
        event_ = None
        arguments_ = []
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
        made = new_node(Send)
        made.span = new_span(Span, (source, start, ends[at]))
        made.event = event_
        made.arguments = arguments_
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
        return model, len(expressions.faults)
    finally:
        # They refer to each other: so they are gone at once, without the garbage collector.
        r_Model = r_Package = r_Optimization = r_ImportRos = r_ImportFile = r_ImportLibrary = r_StructType = r_EnumType = r_AliasType = r_Constant = r_MessageType = r_ServiceType = r_ActionType = r_Event = r_Function = r_Component = r_Member = r_StateMachine = r_Swarm = r_Environment = r_Fitness = r_Field = r_TypeRef = r_EnumValue = r_Setting = r_CountRange = r_ParamRange = r_Communication = r_FunctionPort = r_Param = r_Port = r_Operation = r_BehaviorUse = r_CommunicationSettings = r_Connector = r_Part = r_Variable = r_Initial = r_EnvironmentUse = r_FitnessUse = r_Role = r_RobotValues = r_World = r_Size = r_FitnessInput = r_Objective = r_Parameter = r_PartValue = r_PortRef = r_State = r_Parallel = r_Choice = r_History = r_FinalState = r_Multiplicity = r_Argument = r_Branch = r_Activity = r_Entry = r_Exit = r_Transition = r_Region = r_ResultMapping = r_TimeTrigger = r_MonitorTrigger = r_Send = r_Assignment = r_OutcomeTrigger = r_DoneTrigger = r_EventTrigger = try_ImportRos_ImportFile_ImportLibrary = try_Event_Swarm = try_CountRange_ParamRange = try_Setting_ParamRange = try_Role_RobotValues = try_DoneTrigger_EventTrigger = Import_RULES = Declaration_RULES = OptimizationItem_RULES = FunctionItem_RULES = ComponentItem_RULES = MemberItem_RULES = MachineItem_RULES = SwarmItem_RULES = EnvironmentItem_RULES = FitnessItem_RULES = StateItem_RULES = ParallelItem_RULES = Effect_RULES = Trigger_RULES = RegionItem_RULES = None

LANGUAGE = Language(LEXER, RESERVED)
