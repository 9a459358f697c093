"""Parses .swarm files: made from grammar/*.tx by `make parser`, not to be edited."""

# mypy: ignore-errors
from __future__ import annotations

import re

from swarmdsl.syntax.parser.expressions import ExpressionParser, TooDeepError
from swarmdsl.syntax.parser.literals import Language, unquoted
from swarmdsl.base.source import Source, Span
from swarmdsl.syntax.ast import Ref, Word, ActionType, Activity, Address, AliasType, Append, Area, Argument, Assignment, BehaviorUse, Box, Branch, Cancel, Chance, Choice, Claim, Clear, Communication, CommunicationSettings, Component, Conjunction, Connector, Constant, Contract, CountRange, Defer, DeferredEvent, DeliverySetting, DoneTrigger, Each, Entry, EnumType, EnumValue, Environment, EnvironmentUse, Equipment, Event, EventTrigger, Exit, Fact, Field, FinalState, Fitness, FitnessInput, FitnessUse, Function, FunctionPort, Heartbeat, Height, History, ImportFile, ImportLibrary, ImportRos, Initial, Measure, Member, MessageType, Model, ModelUse, MonitorTrigger, Multiplicity, Objective, Obstacle, Operation, Optimization, OutcomeTrigger, Package, Parallel, Param, ParamRange, Parameter, Part, PartValue, Pattern, Point, Port, PortRef, Property, PropertyScope, Rain, Region, Remove, ResultMapping, RobotValues, Role, SafeState, Send, ServiceType, Setting, Sight, Size, SpaceMeasure, Start, State, StateMachine, StructType, SubjectTo, Swarm, Targets, Term, TimeTrigger, Transition, TypeRef, Variable, Wall, Who, Wind, World, Zone
from swarmdsl.syntax.parser.lexer import Lexer

GRAMMAR = 272762575
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
    REGEX7 = re.compile('(?:[A-Za-z_][A-Za-z0-9_]*(?:\\/[A-Za-z0-9_]+)?|%)(?![A-Za-z0-9_])(?!\\s*:)', re.MULTILINE).match
    return REGEX7(text, at)


def REGEX8(text, at):
    global REGEX8
    REGEX8 = re.compile('-?\\d+\\b(?!\\.\\d)', re.MULTILINE).match
    return REGEX8(text, at)


def REGEX9(text, at):
    global REGEX9
    REGEX9 = re.compile('\\d+\\b', re.MULTILINE).match
    return REGEX9(text, at)


def REGEX10(text, at):
    global REGEX10
    REGEX10 = re.compile('\\d+(?:\\.\\d+)?\\b', re.MULTILINE).match
    return REGEX10(text, at)


def REGEX11(text, at):
    global REGEX11
    REGEX11 = re.compile('(?!(?:aborted|action|actuator|after|and|behavior|choice|communication|connect|const|controller|do|done|else|endless|entry|enum|environment|event|exit|extends|false|final|fitness|function|gives|history|import|in|initial|inout|member|message|monitor|not|on|operation|optimize|or|out|package|parallel|param|preempted|property|region|self|send|sensor|service|state|statemachine|struct|succeeded|swarm|true|type|var|virtual)\\b)[A-Za-z_][A-Za-z0-9_]*\\b|[A-Za-z_][A-Za-z0-9_]*\\b(?=[ \\t]*(?:->|[:;}\\r\\n]|\\/[\\/*]|$))', re.MULTILINE).match
    return REGEX11(text, at)


def REGEX12(text, at):
    global REGEX12
    REGEX12 = re.compile('\\d+(?:\\.\\d+)?[ \\t]*(?:km|cm|mm|m)\\b', re.MULTILINE).match
    return REGEX12(text, at)


def REGEX13(text, at):
    global REGEX13
    REGEX13 = re.compile('\\d+\\b|\\*', re.MULTILINE).match
    return REGEX13(text, at)


def REGEX14(text, at):
    global REGEX14
    REGEX14 = re.compile('==|!=|<=|>=|<|>', re.MULTILINE).match
    return REGEX14(text, at)


def REGEX15(text, at):
    global REGEX15
    REGEX15 = re.compile('(?!:)', re.MULTILINE).match
    return REGEX15(text, at)


def REGEX16(text, at):
    global REGEX16
    REGEX16 = re.compile('(?:(?<=[^\\s;{}][ \\t])|(?<=[^\\s;{}][ \\t]{2})|(?<=[^\\s;{}][ \\t]{3})|(?<=[^\\s;{}][ \\t]{4})|(?<=\\)))after\\b', re.MULTILINE).match
    return REGEX16(text, at)

SET0 = frozenset(['action', 'actuator', 'const', 'controller', 'endless', 'enum', 'environment', 'event', 'fitness', 'function', 'member', 'message', 'operator', 'optimize', 'property', 'sensor', 'service', 'statemachine', 'struct', 'swarm', 'type', 'virtual'])
SET1 = frozenset(['action', 'actuator', 'const', 'controller', 'endless', 'enum', 'environment', 'event', 'fitness', 'function', 'member', 'message', 'operator', 'property', 'sensor', 'service', 'statemachine', 'struct', 'swarm', 'type', 'virtual'])
SET2 = frozenset(['!', '#', '$', '%', '&', "'", '(', ')', '*', '+', ',', '-', '.', '/', ':', ';', '<', '=', '>', '?', '@', '[', '\\', ']', '^', '`', 'aborted', 'action', 'actuator', 'after', 'and', 'behavior', 'choice', 'communication', 'connect', 'const', 'controller', 'do', 'done', 'else', 'endless', 'entry', 'enum', 'environment', 'event', 'exit', 'extends', 'false', 'final', 'fitness', 'function', 'gives', 'history', 'import', 'in', 'initial', 'inout', 'member', 'message', 'monitor', 'not', 'on', 'operation', 'optimize', 'or', 'out', 'package', 'parallel', 'param', 'preempted', 'property', 'region', 'self', 'send', 'sensor', 'service', 'state', 'statemachine', 'struct', 'succeeded', 'swarm', 'true', 'type', 'var', 'virtual', '{', '|', '}', '~', '\x7f'])
SET3 = frozenset(['!', '#', '$', '%', '&', "'", '(', ')', '*', '+', ',', '-', '.', '/', ':', ';', '<', '=', '>', '?', '@', '[', '\\', ']', '^', '`', '{', '|', '}', '~', '\x7f'])
SET4 = frozenset([',', ';'])
SET5 = frozenset(['best', 'deadline', 'keep', 'latest', 'lifespan', 'reliable'])
SET6 = frozenset(['abstraction', 'swarm'])
SET7 = frozenset(['action', 'in', 'model', 'out', 'param', 'service'])
SET8 = frozenset(['behavior', 'in', 'inout', 'operation', 'out', 'param', 'senses'])
SET9 = frozenset(['!', '#', '$', '%', '&', "'", '(', ')', '*', '+', ',', '-', '.', '/', ':', ';', '<', '=', '>', '?', '@', '[', '\\', ']', '^', '`', 'aborted', 'action', 'actuator', 'after', 'and', 'choice', 'const', 'controller', 'do', 'done', 'else', 'endless', 'entry', 'enum', 'environment', 'event', 'exit', 'extends', 'false', 'final', 'fitness', 'function', 'gives', 'history', 'import', 'initial', 'member', 'message', 'monitor', 'not', 'on', 'operation', 'optimize', 'or', 'package', 'parallel', 'preempted', 'property', 'region', 'self', 'send', 'sensor', 'service', 'state', 'statemachine', 'struct', 'succeeded', 'swarm', 'true', 'type', 'var', 'virtual', '{', '|', '}', '~', '\x7f'])
SET10 = frozenset(['choice', 'deep', 'final', 'history', 'initial', 'parallel', 'param', 'state', 'var'])
SET11 = frozenset(['!', '#', '$', '%', '&', "'", '(', ')', '*', '+', ',', '-', '.', '/', ':', ';', '<', '=', '>', '?', '@', '[', '\\', ']', '^', '`', 'aborted', 'action', 'actuator', 'after', 'and', 'behavior', 'choice', 'communication', 'connect', 'const', 'controller', 'do', 'done', 'else', 'endless', 'entry', 'enum', 'event', 'exit', 'extends', 'false', 'final', 'function', 'gives', 'history', 'import', 'in', 'initial', 'inout', 'member', 'message', 'monitor', 'not', 'on', 'operation', 'optimize', 'or', 'out', 'package', 'parallel', 'param', 'preempted', 'property', 'region', 'self', 'send', 'sensor', 'service', 'state', 'statemachine', 'struct', 'succeeded', 'swarm', 'true', 'type', 'var', 'virtual', '{', '|', '}', '~', '\x7f'])
SET12 = frozenset(['area', 'obstacle', 'rain', 'size', 'target', 'wall', 'wind', 'world', 'zone'])
SET13 = frozenset(['in', 'maximize', 'minimize', 'param'])
SET14 = frozenset(['after', 'before', 'between'])
SET15 = frozenset(['.', '/'])
SET16 = frozenset(['latest', 'reliable'])
SET17 = frozenset(['deadline', 'keep', 'lifespan'])
SET18 = frozenset(['!', '#', '$', '%', '&', "'", ')', '+', ',', '-', '.', '/', ':', ';', '<', '=', '>', '?', '@', '[', '\\', ']', '^', '`', 'aborted', 'action', 'actuator', 'after', 'and', 'behavior', 'choice', 'communication', 'connect', 'const', 'controller', 'do', 'done', 'else', 'endless', 'entry', 'enum', 'environment', 'event', 'exit', 'extends', 'false', 'final', 'fitness', 'function', 'gives', 'history', 'import', 'initial', 'inout', 'member', 'message', 'monitor', 'on', 'operation', 'optimize', 'or', 'out', 'package', 'parallel', 'param', 'preempted', 'property', 'region', 'self', 'send', 'sensor', 'service', 'state', 'statemachine', 'struct', 'succeeded', 'swarm', 'true', 'type', 'var', 'virtual', '{', '|', '}', '~', '\x7f'])
SET19 = frozenset(['least', 'most'])
SET20 = frozenset(['at', 'in'])
SET21 = frozenset(['covered', 'distance', 'energy', 'found'])
SET22 = frozenset(['count', 'max', 'mean', 'min', 'sum', 'time', 'total'])
SET23 = frozenset(['!', '#', '$', '%', '&', "'", '(', ')', '+', ',', '-', '.', '/', ':', ';', '<', '=', '>', '?', '@', '[', '\\', ']', '^', '`', 'aborted', 'action', 'actuator', 'after', 'and', 'behavior', 'choice', 'communication', 'connect', 'const', 'controller', 'do', 'done', 'else', 'endless', 'entry', 'enum', 'environment', 'event', 'exit', 'extends', 'false', 'final', 'fitness', 'function', 'gives', 'history', 'import', 'initial', 'inout', 'member', 'message', 'monitor', 'not', 'on', 'operation', 'optimize', 'or', 'out', 'package', 'parallel', 'param', 'preempted', 'property', 'region', 'self', 'send', 'sensor', 'service', 'state', 'statemachine', 'struct', 'succeeded', 'swarm', 'true', 'type', 'var', 'virtual', '{', '|', '}', '~', '\x7f'])
SET24 = frozenset(['in', 'out'])
SET25 = frozenset(['[', 'after', 'choice', 'deep', 'defer', 'do', 'entry', 'exit', 'final', 'history', 'initial', 'internal', 'monitor', 'on', 'parallel', 'state', 'var'])
SET26 = frozenset(['[', 'after', 'defer', 'entry', 'exit', 'internal', 'monitor', 'on', 'region', 'var'])
SET27 = frozenset(['[', 'else'])
SET28 = frozenset(['covered', 'distance', 'energy'])
SET29 = frozenset(['max', 'mean', 'min', 'sum'])
SET30 = frozenset(['max', 'mean', 'min'])
SET31 = frozenset(['hears', 'sends'])
SET32 = frozenset(['cancels', 'starts'])
SET33 = frozenset(['aborted', 'preempted', 'succeeded'])
SET34 = frozenset(['!', '#', '$', '%', '&', "'", '(', ')', '+', ',', '-', '.', '/', ':', ';', '<', '=', '>', '?', '@', '[', '\\', ']', '^', '`', 'aborted', 'action', 'actuator', 'after', 'and', 'behavior', 'choice', 'communication', 'connect', 'const', 'controller', 'do', 'done', 'else', 'endless', 'entry', 'enum', 'environment', 'event', 'exit', 'extends', 'false', 'final', 'fitness', 'function', 'gives', 'history', 'import', 'in', 'initial', 'inout', 'member', 'message', 'monitor', 'not', 'on', 'operation', 'optimize', 'or', 'out', 'package', 'parallel', 'param', 'preempted', 'property', 'region', 'self', 'send', 'sensor', 'service', 'state', 'statemachine', 'struct', 'succeeded', 'swarm', 'true', 'type', 'var', 'virtual', '{', '|', '}', '~', '\x7f'])
SET35 = frozenset(['all', 'no', 'some'])
SET36 = frozenset(['after', 'monitor', 'on'])
SET37 = frozenset(['choice', 'deep', 'final', 'history', 'initial', 'parallel', 'state', 'var'])
RESERVED = frozenset(['aborted', 'action', 'actuator', 'after', 'and', 'behavior', 'choice', 'communication', 'connect', 'const', 'controller', 'do', 'done', 'else', 'endless', 'entry', 'enum', 'environment', 'event', 'exit', 'extends', 'false', 'final', 'fitness', 'function', 'gives', 'history', 'import', 'in', 'initial', 'inout', 'member', 'message', 'monitor', 'not', 'on', 'operation', 'optimize', 'or', 'out', 'package', 'parallel', 'param', 'preempted', 'property', 'region', 'self', 'send', 'sensor', 'service', 'state', 'statemachine', 'struct', 'succeeded', 'swarm', 'true', 'type', 'var', 'virtual'])
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
    ('operator\\b', '', 'operator'),
    ('event\\b', '', 'event'),
    ('on\\b', '', 'on'),
    ('function\\b', '', 'function'),
    ('extends\\b', '', 'extends'),
    ('member\\b', '', 'member'),
    ('endless\\b', '', 'endless'),
    ('statemachine\\b', '', 'statemachine'),
    ('environment\\b', '', 'environment'),
    ('fitness\\b', '', 'fitness'),
    ('of\\b', '', 'of'),
    ('property\\b', '', 'property'),
    ('(?:\\.[A-Za-z_][A-Za-z0-9_]*\\b)*', '', ''),
    ('(?:\\.[A-Za-z_][A-Za-z0-9_]*\\b)*(?:\\.\\*)?', '', ''),
    ('in\\b', '', 'in'),
    ('effort\\b', '', 'effort'),
    ('abstraction\\b', '', 'abstraction'),
    ('sensor\\b', '', 'sensor'),
    ('actuator\\b', '', 'actuator'),
    ('controller\\b', '', 'controller'),
    ('virtual\\b', '', 'virtual'),
    ('each\\b', '', 'each'),
    ('after\\b', '', 'after'),
    ('until\\b', '', 'until'),
    ('before\\b', '', 'before'),
    ('between\\b', '', 'between'),
    ('and\\b', '', 'and'),
    ('never\\b', '', 'never'),
    ('eventually\\b', '', 'eventually'),
    ('within\\b', '', 'within'),
    ('always\\b', '', 'always'),
    ('possible\\b', '', 'possible'),
    ('again\\b', '', 'again'),
    ('at\\b', '', 'at'),
    ('all\\b', '', 'all'),
    ('times\\b', '', 'times'),
    ('most\\b', '', 'most'),
    ('leads\\b', '', 'leads'),
    ('to\\b', '', 'to'),
    ('only\\b', '', 'only'),
    ('then\\b', '', 'then'),
    ('(?!(?:aborted|action|actuator|after|and|behavior|choice|communication|connect|const|controller|do|done|else|endless|entry|enum|environment|event|exit|extends|false|final|fitness|function|gives|history|import|in|initial|inout|member|message|monitor|not|on|operation|optimize|or|out|package|parallel|param|preempted|property|region|self|send|sensor|service|state|statemachine|struct|succeeded|swarm|true|type|var|virtual)\\b)[A-Za-z_][A-Za-z0-9_]*\\b', 'IDENT', ''),
    ('subject\\b', '', 'subject'),
    ('count\\b', '', 'count'),
    ('\\.\\.', '', '..'),
    ('\\.', '', '.'),
    ('step\\b', '', 'step'),
    ('"(?:[^"\\\\\\n]|\\\\[^\\n])*"', 'QUOTED', ''),
    ('(?:[.\\/][A-Za-z_][A-Za-z0-9_]*\\b)*', '', ''),
    ('<=?\\s*-?\\d+\\b', 'STRINGBOUND', ''),
    ('(?:\\[\\s*(?:<=?\\s*)?(?:-?\\d[\\d.]*|\\*)?\\s*\\])+', 'ARRAY', ''),
    ('-?\\d+\\b(?!\\.\\d)', 'INTEGER', ''),
    ('(?:\\/[A-Za-z_][A-Za-z0-9_]*\\b)?', '', ''),
    ('reliable\\b', '', 'reliable'),
    ('latest\\b', '', 'latest'),
    ('best\\b', 'BestEffort', 'best'),
    ('keep\\b', '', 'keep'),
    ('lifespan\\b', '', 'lifespan'),
    ('deadline\\b', '', 'deadline'),
    ('param\\b', '', 'param'),
    ('model\\b', '', 'model'),
    ('\\(', '', '('),
    ('\\)', '', ')'),
    ('operation\\b', '', 'operation'),
    ('behavior\\b', '', 'behavior'),
    ('senses\\b', '', 'senses'),
    ('communication\\b', '', 'communication'),
    ('connect\\b', '', 'connect'),
    ('\\->', '', '->'),
    ('contract\\b', '', 'contract'),
    ('\\[', '', '['),
    ('\\]', '', ']'),
    ('reach\\b', '', 'reach'),
    ('when\\b', '', 'when'),
    ('dead\\b', '', 'dead'),
    ('call\\b', '', 'call'),
    ('var\\b', '', 'var'),
    ('initial\\b', '', 'initial'),
    ('heartbeat\\b', '', 'heartbeat'),
    ('lost\\b', '', 'lost'),
    ('world\\b', '', 'world'),
    ('size\\b', '', 'size'),
    ('x\\b', '', 'x'),
    ('area\\b', '', 'area'),
    ('zone\\b', '', 'zone'),
    ('wall\\b', '', 'wall'),
    ('obstacle\\b', '', 'obstacle'),
    ('radius\\b', '', 'radius'),
    ('target\\b', '', 'target'),
    ('random\\b', '', 'random'),
    ('wind\\b', '', 'wind'),
    ('from\\b', '', 'from'),
    ('rain\\b', '', 'rain'),
    ('or\\b', '', 'or'),
    ('not\\b', '', 'not'),
    ('\\d+\\b', 'INDEX', ''),
    ('least\\b', '', 'least'),
    ('\\d+(?:\\.\\d+)?\\b', 'PROBABILITY', ''),
    ('steps\\b', '', 'steps'),
    ('evaluations\\b', '', 'evaluations'),
    ('seed\\b', '', 'seed'),
    ('[A-Za-z_][A-Za-z0-9_]*\\b', 'WORD', ''),
    ('(?:[A-Za-z_][A-Za-z0-9_]*(?:\\/[A-Za-z0-9_]+)?|%)(?![A-Za-z0-9_])(?!\\s*:)', 'UNIT', ''),
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
    ('body\\b', '', 'body'),
    ('battery\\b', '', 'battery'),
    ('radio\\b', '', 'radio'),
    ('state\\b', '', 'state'),
    ('parallel\\b', '', 'parallel'),
    ('choice\\b', '', 'choice'),
    ('deep\\b', '', 'deep'),
    ('history\\b', '', 'history'),
    ('final\\b', '', 'final'),
    ('\\d+(?:\\.\\d+)?[ \\t]*(?:km|cm|mm|m)\\b', 'LENGTH', ''),
    ('height\\b', '', 'height'),
    ('found\\b', '', 'found'),
    ('total\\b', '', 'total'),
    ('time\\b', '', 'time'),
    ('maximize\\b', '', 'maximize'),
    ('minimize\\b', '', 'minimize'),
    ('has\\b', '', 'has'),
    ('ends\\b', '', 'ends'),
    ('as\\b', '', 'as'),
    ('true\\b', '', 'true'),
    ('false\\b', '', 'false'),
    ('-(?!>)', 'MINUS', ''),
    ('else\\b', '', 'else'),
    ('\\d+\\b|\\*', 'BOUND', ''),
    ('distance\\b', '', 'distance'),
    ('energy\\b', '', 'energy'),
    ('covered\\b', '', 'covered'),
    ('sum\\b', '', 'sum'),
    ('mean\\b', '', 'mean'),
    ('min\\b', '', 'min'),
    ('max\\b', '', 'max'),
    ('sends\\b', '', 'sends'),
    ('hears\\b', '', 'hears'),
    ('starts\\b', '', 'starts'),
    ('cancels\\b', '', 'cancels'),
    ('succeeded\\b', '', 'succeeded'),
    ('aborted\\b', '', 'aborted'),
    ('preempted\\b', '', 'preempted'),
    ('other\\b', '', 'other'),
    ('\\d+(?:\\.\\d+)?(?:[eE][+-]?\\d+)?(?:[ \\t]*(?:(?:m\\/s2|m\\/s|m2|m3|mm|min|mAh|mA|mV|ms|m|km\\/h|kg|kWh|kW|km|cm|rad\\/s2|rad\\/s|rad|degC|deg\\/s|deg|us|s|h|Hz|g|N|J|Wh|W|V|Ah|A)\\b|%(?![ \\t]*(?:(?!(?:and|or)\\b|step[ \\t]+[\\w("-])[A-Za-z_]|[\\d("]|-(?!>))))|\\b)(?!\\.\\d)', 'QUANTITY', ''),
    ('neighbors\\b', '', 'neighbors'),
    ('where\\b', '', 'where'),
    ('by\\b', '', 'by'),
    ('[A-Za-z_][A-Za-z0-9_]*\\b(?=[ \\t]*(?:->|[:;}\\r\\n]|\\/[\\/*]|$))', 'PORTWORD', ''),
    ('do\\b', '', 'do'),
    ('gives\\b', '', 'gives'),
    ('defer\\b', '', 'defer'),
    ('entry\\b', '', 'entry'),
    ('exit\\b', '', 'exit'),
    ('internal\\b', '', 'internal'),
    ('region\\b', '', 'region'),
    ('some\\b', '', 'some'),
    ('no\\b', '', 'no'),
    ('(?!:)', 'NOCOLON', ''),
    ('self\\b', '', 'self'),
    ('=>', '', '=>'),
    ('monitor\\b', '', 'monitor'),
    ('send\\b', '', 'send'),
    ('cancel\\b', '', 'cancel'),
    ('append\\b', '', 'append'),
    ('remove\\b', '', 'remove'),
    ('clear\\b', '', 'clear'),
    ('(?<=[A-Za-z0-9_])(?=\\.)', 'BEFOREDOT', ''),
    ('(?:\\.[A-Za-z_][A-Za-z0-9_]*\\b)+', 'DOTTED', ''),
    ('(?<=[A-Za-z0-9_])(?=\\[)', 'BEFOREINDEX', ''),
    ('done\\b', '', 'done'),
    ('(?:(?<=[^\\s;{}][ \\t])|(?<=[^\\s;{}][ \\t]{2})|(?<=[^\\s;{}][ \\t]{3})|(?<=[^\\s;{}][ \\t]{4})|(?<=\\)))after\\b', 'LATER', ''),
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
    (3, 86),
    (1, 26),
    (0, 1),
    (2, 26),
    (2, 15),
    (4, 0),
    (0, 2),
    (3, 97),
    (4, 0),
    (1, 34),
    (3, 99),
    (2, 38),
    (1, 37),
    (3, 103),
    (2, 38),
    (3, 106),
    (4, 0),
    (1, 42),
    (3, 109),
    (2, 85),
    (1, 45),
    (3, 123),
    (2, 85),
    (1, 48),
    (3, 141),
    (2, 85),
    (1, 51),
    (3, 146),
    (2, 85),
    (1, 54),
    (3, 153),
    (2, 85),
    (1, 57),
    (3, 176),
    (2, 85),
    (1, 60),
    (3, 215),
    (2, 85),
    (1, 63),
    (3, 271),
    (2, 85),
    (1, 66),
    (3, 299),
    (2, 85),
    (1, 69),
    (3, 312),
    (2, 85),
    (1, 72),
    (3, 327),
    (2, 85),
    (1, 75),
    (3, 342),
    (2, 85),
    (1, 78),
    (3, 356),
    (2, 85),
    (1, 81),
    (3, 367),
    (2, 85),
    (1, 84),
    (3, 378),
    (2, 85),
    (3, 393),
    (4, 0),
    (0, 3),
    (3, 411),
    (0, 4),
    (1, 95),
    (3, 414),
    (1, 94),
    (0, 1),
    (2, 94),
    (2, 89),
    (0, 5),
    (4, 0),
    (3, 411),
    (4, 0),
    (0, 6),
    (0, 7),
    (3, 425),
    (4, 0),
    (0, 6),
    (3, 425),
    (4, 0),
    (0, 6),
    (3, 427),
    (4, 0),
    (0, 8),
    (3, 430),
    (0, 4),
    (1, 121),
    (3, 432),
    (1, 120),
    (1, 118),
    (0, 9),
    (2, 119),
    (0, 1),
    (2, 120),
    (2, 112),
    (0, 5),
    (4, 0),
    (0, 10),
    (3, 430),
    (1, 129),
    (0, 11),
    (3, 436),
    (2, 129),
    (0, 4),
    (1, 139),
    (3, 448),
    (1, 138),
    (1, 136),
    (0, 9),
    (2, 137),
    (0, 1),
    (2, 138),
    (2, 130),
    (0, 5),
    (4, 0),
    (0, 12),
    (3, 430),
    (0, 13),
    (3, 436),
    (4, 0),
    (0, 14),
    (3, 430),
    (0, 11),
    (3, 436),
    (0, 13),
    (3, 454),
    (4, 0),
    (0, 15),
    (3, 456),
    (0, 4),
    (1, 174),
    (1, 163),
    (3, 146),
    (1, 162),
    (3, 146),
    (2, 159),
    (2, 167),
    (3, 432),
    (1, 167),
    (3, 432),
    (2, 164),
    (1, 173),
    (1, 171),
    (0, 9),
    (2, 172),
    (0, 1),
    (2, 173),
    (2, 156),
    (0, 5),
    (4, 0),
    (0, 16),
    (3, 456),
    (0, 4),
    (1, 196),
    (0, 17),
    (0, 4),
    (1, 191),
    (3, 432),
    (1, 190),
    (1, 188),
    (0, 9),
    (2, 189),
    (0, 1),
    (2, 190),
    (2, 182),
    (0, 5),
    (1, 195),
    (0, 1),
    (2, 195),
    (2, 196),
    (1, 213),
    (0, 18),
    (0, 4),
    (1, 208),
    (3, 432),
    (1, 207),
    (1, 205),
    (0, 9),
    (2, 206),
    (0, 1),
    (2, 207),
    (2, 199),
    (0, 5),
    (1, 212),
    (0, 1),
    (2, 212),
    (2, 213),
    (0, 5),
    (4, 0),
    (0, 19),
    (3, 456),
    (0, 4),
    (1, 235),
    (0, 20),
    (0, 4),
    (1, 230),
    (3, 432),
    (1, 229),
    (1, 227),
    (0, 9),
    (2, 228),
    (0, 1),
    (2, 229),
    (2, 221),
    (0, 5),
    (1, 234),
    (0, 1),
    (2, 234),
    (2, 235),
    (1, 252),
    (0, 21),
    (0, 4),
    (1, 247),
    (3, 432),
    (1, 246),
    (1, 244),
    (0, 9),
    (2, 245),
    (0, 1),
    (2, 246),
    (2, 238),
    (0, 5),
    (1, 251),
    (0, 1),
    (2, 251),
    (2, 252),
    (1, 269),
    (0, 22),
    (0, 4),
    (1, 264),
    (3, 432),
    (1, 263),
    (1, 261),
    (0, 9),
    (2, 262),
    (0, 1),
    (2, 263),
    (2, 255),
    (0, 5),
    (1, 268),
    (0, 1),
    (2, 268),
    (2, 269),
    (0, 5),
    (4, 0),
    (1, 274),
    (0, 23),
    (2, 274),
    (1, 277),
    (0, 24),
    (2, 277),
    (0, 25),
    (3, 430),
    (0, 11),
    (3, 436),
    (1, 285),
    (0, 26),
    (3, 425),
    (2, 285),
    (1, 298),
    (0, 4),
    (1, 296),
    (3, 458),
    (1, 295),
    (1, 293),
    (0, 9),
    (2, 294),
    (0, 1),
    (2, 295),
    (2, 287),
    (0, 5),
    (2, 298),
    (4, 0),
    (0, 27),
    (3, 430),
    (0, 11),
    (3, 468),
    (0, 4),
    (1, 310),
    (3, 473),
    (1, 309),
    (0, 1),
    (2, 309),
    (2, 304),
    (0, 5),
    (4, 0),
    (3, 484),
    (3, 430),
    (1, 318),
    (0, 28),
    (3, 411),
    (2, 318),
    (0, 4),
    (1, 325),
    (3, 495),
    (1, 324),
    (0, 1),
    (2, 324),
    (2, 319),
    (0, 5),
    (4, 0),
    (0, 29),
    (3, 430),
    (1, 333),
    (0, 28),
    (3, 411),
    (2, 333),
    (0, 4),
    (1, 340),
    (3, 509),
    (1, 339),
    (0, 1),
    (2, 339),
    (2, 334),
    (0, 5),
    (4, 0),
    (1, 345),
    (0, 30),
    (2, 345),
    (0, 31),
    (3, 430),
    (0, 4),
    (1, 354),
    (3, 532),
    (1, 353),
    (0, 1),
    (2, 353),
    (2, 348),
    (0, 5),
    (4, 0),
    (0, 23),
    (3, 430),
    (0, 4),
    (1, 365),
    (3, 543),
    (1, 364),
    (0, 1),
    (2, 364),
    (2, 359),
    (0, 5),
    (4, 0),
    (0, 32),
    (3, 430),
    (0, 4),
    (1, 376),
    (3, 557),
    (1, 375),
    (0, 1),
    (2, 375),
    (2, 370),
    (0, 5),
    (4, 0),
    (0, 33),
    (3, 430),
    (1, 384),
    (0, 34),
    (3, 411),
    (2, 384),
    (0, 4),
    (1, 391),
    (3, 583),
    (1, 390),
    (0, 1),
    (2, 390),
    (2, 385),
    (0, 5),
    (4, 0),
    (0, 35),
    (3, 430),
    (1, 399),
    (0, 34),
    (3, 411),
    (2, 399),
    (0, 11),
    (1, 403),
    (3, 591),
    (2, 403),
    (1, 406),
    (3, 595),
    (2, 406),
    (3, 615),
    (1, 410),
    (3, 675),
    (2, 410),
    (4, 0),
    (3, 679),
    (0, 36),
    (4, 0),
    (1, 417),
    (3, 681),
    (2, 424),
    (1, 420),
    (3, 684),
    (2, 424),
    (1, 423),
    (3, 688),
    (2, 424),
    (3, 696),
    (4, 0),
    (3, 708),
    (4, 0),
    (3, 679),
    (0, 37),
    (4, 0),
    (3, 679),
    (4, 0),
    (3, 710),
    (0, 11),
    (3, 436),
    (4, 0),
    (3, 712),
    (1, 440),
    (3, 715),
    (2, 440),
    (1, 443),
    (3, 717),
    (2, 443),
    (1, 447),
    (0, 38),
    (3, 719),
    (2, 447),
    (4, 0),
    (3, 430),
    (1, 453),
    (0, 13),
    (3, 721),
    (2, 453),
    (4, 0),
    (3, 723),
    (4, 0),
    (3, 729),
    (4, 0),
    (1, 461),
    (3, 732),
    (2, 467),
    (1, 465),
    (3, 737),
    (0, 39),
    (2, 467),
    (3, 739),
    (3, 454),
    (4, 0),
    (1, 471),
    (0, 40),
    (2, 472),
    (0, 23),
    (4, 0),
    (1, 476),
    (3, 747),
    (2, 483),
    (1, 479),
    (3, 752),
    (2, 483),
    (1, 482),
    (3, 757),
    (2, 483),
    (3, 766),
    (4, 0),
    (1, 487),
    (0, 41),
    (2, 494),
    (1, 490),
    (0, 42),
    (2, 494),
    (1, 493),
    (0, 43),
    (2, 494),
    (0, 44),
    (4, 0),
    (1, 498),
    (3, 780),
    (2, 508),
    (1, 501),
    (3, 757),
    (2, 508),
    (1, 504),
    (3, 789),
    (2, 508),
    (1, 507),
    (3, 801),
    (2, 508),
    (3, 804),
    (4, 0),
    (1, 512),
    (3, 801),
    (2, 531),
    (1, 515),
    (3, 820),
    (2, 531),
    (1, 518),
    (3, 834),
    (2, 531),
    (1, 521),
    (3, 780),
    (2, 531),
    (1, 524),
    (3, 757),
    (2, 531),
    (1, 527),
    (3, 847),
    (2, 531),
    (1, 530),
    (3, 852),
    (2, 531),
    (3, 881),
    (4, 0),
    (1, 535),
    (3, 757),
    (2, 542),
    (1, 538),
    (3, 898),
    (2, 542),
    (1, 541),
    (3, 907),
    (2, 542),
    (3, 910),
    (4, 0),
    (1, 546),
    (3, 924),
    (2, 556),
    (1, 549),
    (3, 927),
    (2, 556),
    (1, 552),
    (3, 930),
    (2, 556),
    (1, 555),
    (3, 936),
    (2, 556),
    (3, 961),
    (4, 0),
    (1, 560),
    (3, 993),
    (2, 582),
    (1, 563),
    (3, 996),
    (2, 582),
    (1, 566),
    (3, 1005),
    (2, 582),
    (1, 569),
    (3, 1013),
    (2, 582),
    (1, 572),
    (3, 1021),
    (2, 582),
    (1, 575),
    (3, 1032),
    (2, 582),
    (1, 578),
    (3, 1046),
    (2, 582),
    (1, 581),
    (3, 1067),
    (2, 582),
    (3, 1080),
    (4, 0),
    (1, 586),
    (3, 1090),
    (2, 590),
    (1, 589),
    (3, 757),
    (2, 590),
    (3, 1102),
    (4, 0),
    (0, 45),
    (3, 679),
    (0, 11),
    (4, 0),
    (1, 604),
    (0, 46),
    (3, 1105),
    (1, 602),
    (0, 47),
    (3, 1105),
    (2, 602),
    (0, 9),
    (2, 614),
    (1, 609),
    (0, 48),
    (3, 1105),
    (0, 9),
    (2, 614),
    (0, 49),
    (3, 1111),
    (0, 50),
    (3, 1111),
    (0, 9),
    (4, 0),
    (1, 619),
    (0, 51),
    (3, 1105),
    (2, 674),
    (1, 627),
    (0, 52),
    (3, 1105),
    (1, 626),
    (0, 53),
    (3, 1121),
    (2, 626),
    (2, 674),
    (1, 632),
    (0, 54),
    (0, 55),
    (3, 1105),
    (2, 674),
    (1, 638),
    (0, 56),
    (0, 50),
    (0, 56),
    (3, 1105),
    (2, 674),
    (3, 1105),
    (1, 644),
    (0, 57),
    (0, 58),
    (0, 59),
    (2, 674),
    (1, 650),
    (0, 57),
    (0, 60),
    (3, 1123),
    (0, 59),
    (2, 674),
    (1, 659),
    (0, 61),
    (0, 62),
    (3, 1105),
    (1, 658),
    (0, 53),
    (3, 1121),
    (2, 658),
    (2, 674),
    (1, 664),
    (0, 63),
    (0, 46),
    (3, 1105),
    (2, 674),
    (1, 672),
    (0, 64),
    (3, 1105),
    (1, 671),
    (0, 64),
    (3, 1105),
    (2, 667),
    (2, 674),
    (0, 53),
    (3, 1121),
    (4, 0),
    (0, 57),
    (3, 1125),
    (3, 1130),
    (4, 0),
    (0, 65),
    (4, 0),
    (3, 1132),
    (3, 454),
    (4, 0),
    (0, 66),
    (0, 62),
    (3, 411),
    (4, 0),
    (0, 67),
    (0, 34),
    (3, 679),
    (0, 38),
    (3, 454),
    (0, 68),
    (3, 454),
    (4, 0),
    (3, 679),
    (0, 69),
    (3, 679),
    (0, 38),
    (3, 454),
    (0, 68),
    (3, 454),
    (1, 707),
    (0, 70),
    (3, 454),
    (2, 707),
    (4, 0),
    (0, 71),
    (4, 0),
    (3, 1140),
    (4, 0),
    (3, 679),
    (0, 72),
    (4, 0),
    (0, 73),
    (4, 0),
    (0, 74),
    (4, 0),
    (3, 1142),
    (4, 0),
    (0, 75),
    (4, 0),
    (3, 1144),
    (1, 728),
    (3, 1149),
    (3, 1144),
    (2, 724),
    (4, 0),
    (3, 679),
    (0, 76),
    (4, 0),
    (1, 735),
    (0, 77),
    (2, 736),
    (0, 78),
    (4, 0),
    (0, 79),
    (4, 0),
    (1, 742),
    (0, 80),
    (2, 746),
    (1, 745),
    (0, 81),
    (2, 746),
    (0, 82),
    (4, 0),
    (3, 1187),
    (3, 425),
    (0, 11),
    (3, 436),
    (4, 0),
    (3, 1192),
    (3, 425),
    (0, 11),
    (3, 436),
    (4, 0),
    (0, 83),
    (3, 430),
    (0, 11),
    (3, 436),
    (1, 765),
    (0, 13),
    (3, 454),
    (2, 765),
    (4, 0),
    (0, 84),
    (3, 430),
    (1, 779),
    (0, 85),
    (1, 777),
    (3, 1197),
    (1, 776),
    (0, 9),
    (3, 1197),
    (2, 772),
    (2, 777),
    (0, 86),
    (2, 779),
    (4, 0),
    (3, 1201),
    (3, 1209),
    (0, 11),
    (3, 436),
    (1, 788),
    (0, 26),
    (3, 425),
    (2, 788),
    (4, 0),
    (0, 87),
    (3, 430),
    (0, 85),
    (1, 799),
    (3, 1211),
    (1, 798),
    (0, 9),
    (3, 1211),
    (2, 794),
    (2, 799),
    (0, 86),
    (4, 0),
    (0, 88),
    (3, 411),
    (4, 0),
    (0, 89),
    (3, 1140),
    (1, 819),
    (0, 4),
    (1, 817),
    (3, 1219),
    (1, 816),
    (1, 814),
    (0, 9),
    (2, 815),
    (0, 1),
    (2, 816),
    (2, 808),
    (0, 5),
    (2, 819),
    (4, 0),
    (0, 90),
    (3, 430),
    (0, 4),
    (1, 832),
    (3, 1219),
    (1, 831),
    (1, 829),
    (0, 9),
    (2, 830),
    (0, 1),
    (2, 831),
    (2, 823),
    (0, 5),
    (4, 0),
    (3, 1223),
    (0, 4),
    (1, 845),
    (3, 1219),
    (1, 844),
    (1, 842),
    (0, 9),
    (2, 843),
    (0, 1),
    (2, 844),
    (2, 836),
    (0, 5),
    (4, 0),
    (0, 91),
    (3, 1231),
    (0, 92),
    (3, 1231),
    (4, 0),
    (0, 93),
    (3, 430),
    (0, 11),
    (1, 876),
    (0, 26),
    (3, 1237),
    (1, 862),
    (0, 9),
    (3, 1237),
    (2, 858),
    (1, 867),
    (0, 94),
    (3, 454),
    (0, 95),
    (2, 867),
    (0, 53),
    (3, 1121),
    (0, 96),
    (3, 1239),
    (1, 875),
    (0, 9),
    (3, 1239),
    (2, 871),
    (2, 880),
    (0, 97),
    (0, 98),
    (0, 99),
    (3, 411),
    (4, 0),
    (3, 430),
    (0, 11),
    (3, 411),
    (1, 897),
    (0, 4),
    (1, 895),
    (3, 1219),
    (1, 894),
    (1, 892),
    (0, 9),
    (2, 893),
    (0, 1),
    (2, 894),
    (2, 886),
    (0, 5),
    (2, 897),
    (4, 0),
    (0, 100),
    (3, 430),
    (0, 11),
    (3, 436),
    (1, 906),
    (0, 13),
    (3, 454),
    (2, 906),
    (4, 0),
    (0, 101),
    (3, 411),
    (4, 0),
    (1, 913),
    (3, 1241),
    (2, 923),
    (1, 916),
    (3, 1269),
    (2, 923),
    (1, 919),
    (3, 1281),
    (2, 923),
    (1, 922),
    (3, 1292),
    (2, 923),
    (3, 1302),
    (4, 0),
    (0, 32),
    (3, 411),
    (4, 0),
    (0, 33),
    (3, 411),
    (4, 0),
    (0, 102),
    (3, 454),
    (0, 103),
    (0, 46),
    (3, 454),
    (4, 0),
    (3, 430),
    (0, 11),
    (3, 411),
    (1, 944),
    (0, 94),
    (3, 1305),
    (0, 95),
    (2, 944),
    (1, 947),
    (3, 1311),
    (2, 947),
    (1, 960),
    (0, 4),
    (1, 958),
    (3, 1219),
    (1, 957),
    (1, 955),
    (0, 9),
    (2, 956),
    (0, 1),
    (2, 957),
    (2, 949),
    (0, 5),
    (2, 960),
    (4, 0),
    (3, 679),
    (0, 94),
    (3, 1123),
    (0, 95),
    (1, 981),
    (3, 1311),
    (1, 980),
    (0, 4),
    (1, 978),
    (3, 1219),
    (1, 977),
    (1, 975),
    (0, 9),
    (2, 976),
    (0, 1),
    (2, 977),
    (2, 969),
    (0, 5),
    (2, 980),
    (2, 992),
    (0, 4),
    (1, 991),
    (3, 1219),
    (1, 990),
    (1, 988),
    (0, 9),
    (2, 989),
    (0, 1),
    (2, 990),
    (2, 982),
    (0, 5),
    (4, 0),
    (0, 104),
    (3, 425),
    (4, 0),
    (0, 105),
    (3, 1318),
    (0, 106),
    (3, 1318),
    (1, 1004),
    (0, 106),
    (3, 1318),
    (2, 1004),
    (4, 0),
    (0, 107),
    (3, 430),
    (0, 11),
    (3, 1320),
    (1, 1012),
    (3, 1324),
    (2, 1012),
    (4, 0),
    (0, 108),
    (3, 430),
    (0, 11),
    (3, 1320),
    (1, 1020),
    (3, 1324),
    (2, 1020),
    (4, 0),
    (0, 109),
    (0, 11),
    (3, 1331),
    (1, 1028),
    (0, 92),
    (3, 1331),
    (2, 1024),
    (1, 1031),
    (3, 1324),
    (2, 1031),
    (4, 0),
    (0, 110),
    (3, 430),
    (0, 11),
    (3, 1331),
    (1, 1040),
    (0, 68),
    (3, 1331),
    (2, 1042),
    (0, 111),
    (3, 454),
    (1, 1045),
    (3, 1324),
    (2, 1045),
    (4, 0),
    (0, 112),
    (3, 710),
    (1, 1053),
    (0, 94),
    (3, 1123),
    (0, 95),
    (2, 1053),
    (0, 57),
    (1, 1061),
    (0, 113),
    (1, 1060),
    (0, 38),
    (3, 679),
    (2, 1060),
    (2, 1066),
    (3, 1331),
    (1, 1066),
    (0, 9),
    (3, 1331),
    (2, 1062),
    (4, 0),
    (0, 114),
    (3, 454),
    (0, 62),
    (3, 454),
    (1, 1075),
    (0, 115),
    (3, 454),
    (2, 1075),
    (1, 1079),
    (0, 47),
    (3, 454),
    (2, 1079),
    (4, 0),
    (0, 116),
    (1, 1085),
    (0, 115),
    (3, 454),
    (2, 1085),
    (1, 1089),
    (0, 47),
    (3, 454),
    (2, 1089),
    (4, 0),
    (0, 38),
    (3, 430),
    (0, 11),
    (3, 436),
    (1, 1101),
    (0, 13),
    (1, 1099),
    (3, 1337),
    (2, 1100),
    (3, 1348),
    (2, 1101),
    (4, 0),
    (3, 1380),
    (3, 454),
    (4, 0),
    (3, 1385),
    (1, 1110),
    (0, 117),
    (3, 1385),
    (2, 1106),
    (4, 0),
    (1, 1114),
    (0, 118),
    (2, 1114),
    (1, 1119),
    (0, 85),
    (3, 1105),
    (0, 86),
    (2, 1120),
    (3, 1391),
    (4, 0),
    (3, 1471),
    (4, 0),
    (0, 119),
    (4, 0),
    (1, 1128),
    (0, 120),
    (2, 1129),
    (0, 60),
    (4, 0),
    (0, 121),
    (4, 0),
    (1, 1135),
    (0, 122),
    (2, 1139),
    (1, 1138),
    (0, 123),
    (2, 1139),
    (0, 124),
    (4, 0),
    (0, 125),
    (4, 0),
    (0, 126),
    (4, 0),
    (1, 1147),
    (3, 1477),
    (2, 1144),
    (3, 1482),
    (4, 0),
    (1, 1152),
    (0, 50),
    (2, 1186),
    (1, 1155),
    (0, 117),
    (2, 1186),
    (1, 1158),
    (0, 127),
    (2, 1186),
    (1, 1161),
    (0, 128),
    (2, 1186),
    (1, 1164),
    (0, 129),
    (2, 1186),
    (1, 1167),
    (0, 130),
    (2, 1186),
    (1, 1170),
    (0, 131),
    (2, 1186),
    (1, 1173),
    (0, 132),
    (2, 1186),
    (1, 1176),
    (0, 133),
    (2, 1186),
    (1, 1179),
    (3, 1516),
    (2, 1186),
    (1, 1182),
    (0, 134),
    (2, 1186),
    (1, 1185),
    (0, 135),
    (2, 1186),
    (0, 136),
    (4, 0),
    (1, 1190),
    (0, 19),
    (2, 1191),
    (0, 16),
    (4, 0),
    (1, 1195),
    (0, 38),
    (2, 1196),
    (0, 137),
    (4, 0),
    (3, 710),
    (0, 13),
    (3, 454),
    (4, 0),
    (1, 1204),
    (0, 138),
    (2, 1208),
    (1, 1207),
    (0, 38),
    (2, 1208),
    (0, 137),
    (4, 0),
    (3, 1518),
    (4, 0),
    (1, 1215),
    (3, 1192),
    (3, 710),
    (2, 1216),
    (3, 710),
    (0, 11),
    (3, 436),
    (4, 0),
    (3, 710),
    (0, 13),
    (3, 454),
    (4, 0),
    (1, 1226),
    (0, 139),
    (2, 1230),
    (1, 1229),
    (0, 140),
    (2, 1230),
    (0, 141),
    (4, 0),
    (1, 1235),
    (3, 679),
    (0, 69),
    (2, 1235),
    (3, 1518),
    (4, 0),
    (3, 411),
    (4, 0),
    (3, 411),
    (4, 0),
    (0, 142),
    (3, 430),
    (1, 1258),
    (0, 13),
    (3, 411),
    (1, 1257),
    (0, 85),
    (1, 1255),
    (3, 1197),
    (1, 1254),
    (0, 9),
    (3, 1197),
    (2, 1250),
    (2, 1255),
    (0, 86),
    (2, 1257),
    (2, 1258),
    (1, 1268),
    (0, 4),
    (1, 1266),
    (3, 1523),
    (1, 1265),
    (0, 1),
    (2, 1265),
    (2, 1260),
    (0, 5),
    (2, 1268),
    (4, 0),
    (0, 143),
    (0, 142),
    (3, 430),
    (0, 4),
    (1, 1279),
    (3, 1546),
    (1, 1278),
    (0, 1),
    (2, 1278),
    (2, 1273),
    (0, 5),
    (4, 0),
    (0, 144),
    (3, 430),
    (0, 4),
    (1, 1290),
    (3, 1563),
    (1, 1289),
    (0, 1),
    (2, 1289),
    (2, 1284),
    (0, 5),
    (4, 0),
    (1, 1295),
    (0, 145),
    (2, 1295),
    (0, 146),
    (3, 430),
    (1, 1301),
    (0, 92),
    (3, 411),
    (2, 1301),
    (4, 0),
    (0, 147),
    (3, 430),
    (4, 0),
    (3, 1580),
    (1, 1310),
    (0, 68),
    (3, 1580),
    (2, 1310),
    (4, 0),
    (1, 1315),
    (0, 38),
    (3, 679),
    (2, 1317),
    (0, 57),
    (3, 1331),
    (4, 0),
    (0, 148),
    (4, 0),
    (3, 1331),
    (0, 68),
    (3, 1331),
    (4, 0),
    (0, 149),
    (3, 454),
    (1, 1330),
    (0, 68),
    (3, 454),
    (2, 1330),
    (4, 0),
    (0, 85),
    (3, 454),
    (0, 9),
    (3, 454),
    (0, 86),
    (4, 0),
    (1, 1343),
    (3, 1582),
    (0, 85),
    (3, 679),
    (0, 86),
    (2, 1347),
    (0, 150),
    (0, 85),
    (3, 1140),
    (0, 86),
    (4, 0),
    (1, 1352),
    (3, 1590),
    (3, 591),
    (2, 1352),
    (1, 1358),
    (0, 67),
    (0, 85),
    (3, 1105),
    (0, 86),
    (2, 1379),
    (1, 1364),
    (0, 151),
    (0, 85),
    (3, 1105),
    (0, 86),
    (2, 1379),
    (1, 1374),
    (0, 152),
    (1, 1370),
    (0, 47),
    (3, 1105),
    (2, 1373),
    (0, 85),
    (3, 1105),
    (0, 86),
    (2, 1379),
    (3, 1601),
    (0, 67),
    (0, 85),
    (3, 1105),
    (0, 86),
    (4, 0),
    (1, 1383),
    (0, 153),
    (2, 1384),
    (0, 154),
    (4, 0),
    (3, 1111),
    (1, 1390),
    (0, 50),
    (3, 1111),
    (2, 1386),
    (4, 0),
    (1, 1401),
    (0, 67),
    (0, 85),
    (3, 679),
    (0, 38),
    (3, 411),
    (0, 86),
    (3, 1609),
    (3, 1123),
    (2, 1470),
    (1, 1405),
    (0, 38),
    (3, 411),
    (2, 1470),
    (1, 1411),
    (0, 155),
    (0, 94),
    (3, 454),
    (0, 95),
    (2, 1470),
    (1, 1420),
    (3, 1626),
    (3, 411),
    (1, 1419),
    (0, 94),
    (3, 454),
    (0, 95),
    (2, 1419),
    (2, 1470),
    (1, 1424),
    (3, 1631),
    (3, 411),
    (2, 1470),
    (1, 1432),
    (0, 156),
    (3, 411),
    (1, 1431),
    (0, 157),
    (3, 1636),
    (2, 1431),
    (2, 1470),
    (1, 1464),
    (3, 1644),
    (1, 1438),
    (0, 38),
    (3, 1666),
    (2, 1463),
    (1, 1444),
    (0, 155),
    (0, 94),
    (3, 454),
    (0, 95),
    (2, 1463),
    (1, 1453),
    (3, 1626),
    (3, 411),
    (1, 1452),
    (0, 94),
    (3, 454),
    (0, 95),
    (2, 1452),
    (2, 1463),
    (1, 1457),
    (3, 1631),
    (3, 411),
    (2, 1463),
    (0, 156),
    (3, 411),
    (1, 1463),
    (0, 157),
    (3, 1636),
    (2, 1463),
    (2, 1470),
    (3, 411),
    (1, 1470),
    (0, 94),
    (3, 454),
    (0, 95),
    (2, 1470),
    (4, 0),
    (3, 1144),
    (1, 1476),
    (3, 1669),
    (3, 1144),
    (2, 1472),
    (4, 0),
    (1, 1480),
    (0, 118),
    (2, 1481),
    (3, 1516),
    (4, 0),
    (1, 1485),
    (3, 1677),
    (2, 1515),
    (1, 1488),
    (3, 708),
    (2, 1515),
    (1, 1491),
    (0, 158),
    (2, 1515),
    (1, 1494),
    (0, 159),
    (2, 1515),
    (1, 1497),
    (3, 1679),
    (2, 1515),
    (1, 1500),
    (3, 1687),
    (2, 1515),
    (1, 1503),
    (3, 1691),
    (2, 1515),
    (1, 1506),
    (3, 1706),
    (2, 1515),
    (1, 1509),
    (3, 1718),
    (2, 1515),
    (1, 1512),
    (3, 1729),
    (2, 1515),
    (0, 85),
    (3, 723),
    (0, 86),
    (4, 0),
    (0, 160),
    (4, 0),
    (1, 1521),
    (3, 679),
    (2, 1522),
    (3, 1738),
    (4, 0),
    (1, 1526),
    (3, 898),
    (2, 1545),
    (1, 1529),
    (3, 1740),
    (2, 1545),
    (1, 1532),
    (3, 1772),
    (2, 1545),
    (1, 1535),
    (3, 1779),
    (2, 1545),
    (1, 1538),
    (3, 1787),
    (2, 1545),
    (1, 1541),
    (3, 1795),
    (2, 1545),
    (1, 1544),
    (3, 907),
    (2, 1545),
    (3, 910),
    (4, 0),
    (1, 1549),
    (3, 898),
    (2, 1562),
    (1, 1552),
    (3, 1861),
    (2, 1562),
    (1, 1555),
    (3, 1772),
    (2, 1562),
    (1, 1558),
    (3, 1779),
    (2, 1562),
    (1, 1561),
    (3, 1787),
    (2, 1562),
    (3, 1795),
    (4, 0),
    (1, 1568),
    (0, 94),
    (3, 454),
    (0, 95),
    (2, 1569),
    (0, 161),
    (1, 1577),
    (0, 135),
    (3, 1872),
    (1, 1576),
    (0, 9),
    (3, 1872),
    (2, 1572),
    (2, 1577),
    (0, 92),
    (3, 411),
    (4, 0),
    (0, 162),
    (4, 0),
    (1, 1585),
    (0, 163),
    (2, 1589),
    (1, 1588),
    (0, 164),
    (2, 1589),
    (0, 165),
    (4, 0),
    (1, 1593),
    (0, 166),
    (2, 1600),
    (1, 1596),
    (0, 167),
    (2, 1600),
    (1, 1599),
    (0, 168),
    (2, 1600),
    (0, 169),
    (4, 0),
    (1, 1604),
    (0, 167),
    (2, 1608),
    (1, 1607),
    (0, 168),
    (2, 1608),
    (0, 169),
    (4, 0),
    (1, 1612),
    (0, 127),
    (2, 1625),
    (1, 1615),
    (0, 128),
    (2, 1625),
    (1, 1618),
    (0, 129),
    (2, 1625),
    (1, 1621),
    (0, 130),
    (2, 1625),
    (1, 1624),
    (0, 131),
    (2, 1625),
    (0, 132),
    (4, 0),
    (1, 1629),
    (0, 170),
    (2, 1630),
    (0, 171),
    (4, 0),
    (1, 1634),
    (0, 172),
    (2, 1635),
    (0, 173),
    (4, 0),
    (1, 1639),
    (0, 174),
    (2, 1643),
    (1, 1642),
    (0, 175),
    (2, 1643),
    (0, 176),
    (4, 0),
    (1, 1651),
    (3, 1889),
    (1, 1649),
    (0, 177),
    (2, 1649),
    (3, 679),
    (2, 1665),
    (1, 1659),
    (3, 1580),
    (1, 1657),
    (0, 68),
    (3, 1580),
    (2, 1657),
    (3, 679),
    (2, 1665),
    (3, 679),
    (1, 1665),
    (0, 94),
    (3, 1123),
    (0, 95),
    (2, 1665),
    (4, 0),
    (3, 411),
    (3, 1897),
    (4, 0),
    (1, 1672),
    (0, 133),
    (2, 1676),
    (1, 1675),
    (3, 1516),
    (2, 1676),
    (0, 134),
    (4, 0),
    (0, 178),
    (4, 0),
    (0, 38),
    (0, 85),
    (3, 679),
    (1, 1685),
    (3, 1899),
    (2, 1685),
    (0, 86),
    (4, 0),
    (0, 179),
    (0, 53),
    (3, 1482),
    (4, 0),
    (3, 679),
    (0, 85),
    (3, 679),
    (0, 38),
    (3, 723),
    (1, 1700),
    (0, 180),
    (3, 723),
    (2, 1700),
    (1, 1704),
    (0, 181),
    (3, 723),
    (2, 1704),
    (0, 86),
    (4, 0),
    (3, 679),
    (1, 1710),
    (3, 1899),
    (2, 1710),
    (0, 85),
    (3, 1902),
    (1, 1716),
    (0, 9),
    (3, 1902),
    (2, 1712),
    (0, 86),
    (4, 0),
    (3, 679),
    (0, 85),
    (1, 1727),
    (3, 723),
    (1, 1726),
    (0, 9),
    (3, 723),
    (2, 1722),
    (2, 1727),
    (0, 86),
    (4, 0),
    (3, 1906),
    (1, 1737),
    (1, 1735),
    (0, 69),
    (3, 1140),
    (2, 1736),
    (3, 1914),
    (2, 1730),
    (4, 0),
    (0, 182),
    (4, 0),
    (0, 183),
    (3, 411),
    (1, 1757),
    (0, 85),
    (1, 1748),
    (0, 181),
    (3, 430),
    (2, 1755),
    (1, 1755),
    (3, 1197),
    (1, 1754),
    (0, 9),
    (3, 1197),
    (2, 1750),
    (2, 1755),
    (0, 86),
    (2, 1757),
    (1, 1771),
    (0, 184),
    (1, 1763),
    (0, 181),
    (3, 430),
    (2, 1770),
    (0, 85),
    (3, 1919),
    (1, 1769),
    (0, 9),
    (3, 1919),
    (2, 1765),
    (0, 86),
    (2, 1771),
    (4, 0),
    (0, 185),
    (3, 1923),
    (1, 1778),
    (0, 9),
    (3, 1923),
    (2, 1774),
    (4, 0),
    (0, 186),
    (0, 135),
    (3, 1872),
    (1, 1786),
    (0, 9),
    (3, 1872),
    (2, 1782),
    (4, 0),
    (0, 187),
    (0, 135),
    (3, 1872),
    (1, 1794),
    (0, 9),
    (3, 1872),
    (2, 1790),
    (4, 0),
    (1, 1798),
    (0, 188),
    (2, 1798),
    (1, 1839),
    (1, 1807),
    (0, 26),
    (3, 1925),
    (1, 1806),
    (0, 9),
    (3, 1925),
    (2, 1802),
    (2, 1819),
    (1, 1814),
    (3, 1933),
    (1, 1813),
    (0, 9),
    (3, 1933),
    (2, 1809),
    (2, 1819),
    (3, 1936),
    (1, 1819),
    (0, 9),
    (3, 1936),
    (2, 1815),
    (1, 1824),
    (0, 94),
    (3, 454),
    (0, 95),
    (2, 1824),
    (1, 1836),
    (0, 135),
    (3, 1872),
    (1, 1831),
    (0, 9),
    (3, 1872),
    (2, 1827),
    (1, 1835),
    (0, 92),
    (3, 411),
    (2, 1835),
    (2, 1838),
    (0, 92),
    (3, 411),
    (2, 1860),
    (1, 1847),
    (0, 26),
    (3, 1945),
    (1, 1846),
    (0, 9),
    (3, 1945),
    (2, 1842),
    (2, 1860),
    (0, 94),
    (3, 454),
    (0, 95),
    (1, 1858),
    (0, 135),
    (3, 1872),
    (1, 1857),
    (0, 9),
    (3, 1872),
    (2, 1853),
    (2, 1858),
    (0, 92),
    (3, 411),
    (4, 0),
    (0, 189),
    (3, 430),
    (0, 4),
    (1, 1870),
    (3, 1947),
    (1, 1869),
    (0, 1),
    (2, 1869),
    (2, 1864),
    (0, 5),
    (4, 0),
    (1, 1875),
    (3, 1955),
    (2, 1888),
    (1, 1878),
    (3, 1977),
    (2, 1888),
    (1, 1881),
    (3, 1980),
    (2, 1888),
    (1, 1884),
    (3, 1985),
    (2, 1888),
    (1, 1887),
    (3, 1988),
    (2, 1888),
    (3, 1991),
    (4, 0),
    (1, 1892),
    (0, 58),
    (2, 1896),
    (1, 1895),
    (0, 190),
    (2, 1896),
    (0, 191),
    (4, 0),
    (0, 192),
    (4, 0),
    (3, 1995),
    (3, 1997),
    (4, 0),
    (3, 1140),
    (0, 13),
    (3, 723),
    (4, 0),
    (1, 1909),
    (0, 25),
    (2, 1913),
    (1, 1912),
    (0, 193),
    (2, 1913),
    (3, 679),
    (4, 0),
    (3, 1999),
    (0, 94),
    (3, 723),
    (0, 95),
    (4, 0),
    (3, 710),
    (0, 194),
    (3, 2001),
    (4, 0),
    (3, 411),
    (4, 0),
    (1, 1928),
    (3, 1945),
    (2, 1932),
    (1, 1931),
    (3, 2003),
    (2, 1932),
    (3, 1237),
    (4, 0),
    (0, 46),
    (3, 1121),
    (4, 0),
    (0, 195),
    (3, 425),
    (0, 11),
    (3, 436),
    (1, 1944),
    (0, 157),
    (3, 430),
    (2, 1944),
    (4, 0),
    (3, 1636),
    (4, 0),
    (1, 1950),
    (3, 898),
    (2, 1954),
    (1, 1953),
    (3, 907),
    (2, 1954),
    (3, 910),
    (4, 0),
    (0, 196),
    (3, 411),
    (1, 1968),
    (0, 85),
    (1, 1966),
    (3, 1197),
    (1, 1965),
    (0, 9),
    (3, 1197),
    (2, 1961),
    (2, 1966),
    (0, 86),
    (2, 1968),
    (1, 1972),
    (0, 62),
    (3, 2013),
    (2, 1972),
    (1, 1976),
    (3, 2015),
    (3, 1121),
    (2, 1976),
    (4, 0),
    (0, 197),
    (3, 411),
    (4, 0),
    (0, 198),
    (3, 454),
    (0, 62),
    (3, 2001),
    (4, 0),
    (0, 199),
    (3, 2001),
    (4, 0),
    (0, 200),
    (3, 2001),
    (4, 0),
    (3, 2001),
    (0, 13),
    (3, 454),
    (4, 0),
    (0, 201),
    (4, 0),
    (0, 202),
    (4, 0),
    (0, 203),
    (4, 0),
    (3, 1144),
    (4, 0),
    (1, 2007),
    (3, 679),
    (0, 69),
    (2, 2007),
    (0, 204),
    (1, 2012),
    (0, 69),
    (3, 679),
    (2, 2012),
    (4, 0),
    (3, 454),
    (4, 0),
    (0, 205),
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
        start = ends[at + 1] - len(token)
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        swarm_ = False
        operator_ = False
        name_ = None
        type_ = None
        topic_ = None
        delivery_ = []
        if token == 'swarm':
            at += 1; token = tokens[at]
            swarm_ = True
        if token == 'operator':
            at += 1; token = tokens[at]
            operator_ = True
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
        if token == '{':
            before5 = at
            before6 = len(delivery_)
            while True:
                at += 1; token = tokens[at]
                while token in SET5:
                    before7 = at
                    before8 = len(delivery_)
                    value = r_DeliverySetting()
                    if value is None: at = before7; token = tokens[at]; del delivery_[before8:]; break
                    delivery_.append(value)
                    if token in SET4:
                        at += 1; token = tokens[at]
                if not (token == '}'): at = before5; token = tokens[at]; del delivery_[before6:]; break
                at += 1; token = tokens[at]
                break
        made = new_node(Event)
        made.span = new_span(Span, (source, start, ends[at]))
        made.swarm = swarm_
        made.operator = operator_
        made.name = name_
        made.type = type_
        made.topic = topic_
        made.delivery = delivery_
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
        if not (token in SET6): return None
        taken2 = token; at += 1; token = tokens[at]
        category_ = taken2
        if not (token == '{'): return None
        at += 1; token = tokens[at]
        while token in SET7:
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
        while token in SET8:
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
        while token >= 'A' and token not in SET9:
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
        while token in SET10:
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
        while token >= 'A' and token not in SET11:
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
        while token in SET12:
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
        subject_ = None
        items_ = []
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if token == 'of':
            before2 = at
            before3 = subject_
            while True:
                at += 1; token = tokens[at]
                first = ends[at + 1] - len(token)
                if not (token >= 'A' and token not in SET2): at = before2; token = tokens[at]; subject_ = before3; break
                taken5 = token; at += 1; token = tokens[at]
                text4 = taken5
                if token == '.':
                    match6 = REGEX0(text, ends[at + 1] - len(token))
                    if match6[0]:
                        text4 += match6[0]
                        end = match6.end()
                        while ends[at] < end: at += 1
                        if ends[at] > end: at = before2; token = tokens[at]; subject_ = before3; break
                        token = tokens[at]
                value = new_node(Ref)
                value.name = text4
                value.kind = 'Swarm'
                value.span = new_span(Span, (source, first, first + len(text4)))
                value.target = None
                subject_ = value
                break
        if not (token == '{'): return None
        at += 1; token = tokens[at]
        while token in SET13:
            before7 = at
            before8 = len(items_)
            rule = FitnessItem_RULES.get(token)
            if rule is None: at = before7; token = tokens[at]; del items_[before8:]; break
            value = rule()
            if value is None: at = before7; token = tokens[at]; del items_[before8:]; break
            items_.append(value)
            if token == ';':
                at += 1; token = tokens[at]
        if not (token == '}'): return None
        at += 1; token = tokens[at]
        made = new_node(Fitness)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.subject = subject_
        made.items = items_
        made.doc = docs.pop(start) if start in docs else ''
        made.by_class = None
        made.about = None
        return made

    def r_Property():
        nonlocal at, token
        start = ends[at + 1] - 8
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        subject_ = None
        each_ = None
        scope_ = None
        body_ = None
        chance_ = None
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if token == 'of':
            before2 = at
            before3 = subject_
            while True:
                at += 1; token = tokens[at]
                first = ends[at + 1] - len(token)
                if not (token >= 'A' and token not in SET2): at = before2; token = tokens[at]; subject_ = before3; break
                taken5 = token; at += 1; token = tokens[at]
                text4 = taken5
                if token == '.':
                    match6 = REGEX0(text, ends[at + 1] - len(token))
                    if match6[0]:
                        text4 += match6[0]
                        end = match6.end()
                        while ends[at] < end: at += 1
                        if ends[at] > end: at = before2; token = tokens[at]; subject_ = before3; break
                        token = tokens[at]
                value = new_node(Ref)
                value.name = text4
                value.kind = 'PropertySubject'
                value.span = new_span(Span, (source, first, first + len(text4)))
                value.target = None
                subject_ = value
                break
        if not (token == ':'): return None
        at += 1; token = tokens[at]
        if token == 'each':
            before7 = at
            while True:
                value = r_Each()
                if value is None: at = before7; token = tokens[at]; break
                each_ = value
                break
        if token in SET14:
            before8 = at
            while True:
                value = r_PropertyScope()
                if value is None: at = before8; token = tokens[at]; break
                scope_ = value
                break
        value = r_Pattern()
        if value is None: return None
        body_ = value
        if token == 'at':
            before9 = at
            while True:
                value = r_Chance()
                if value is None: at = before9; token = tokens[at]; break
                chance_ = value
                break
        made = new_node(Property)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.subject = subject_
        made.each = each_
        made.scope = scope_
        made.body = body_
        made.chance = chance_
        made.doc = docs.pop(start) if start in docs else ''
        made.by_class = None
        made.about = None
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
        unit_ = None
        if not (token >= 'A' and token not in SET2): return None
        taken2 = token; at += 1; token = tokens[at]
        text1 = taken2
        if token in SET15:
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
        if token == 'in':
            before8 = at
            before9 = unit_
            while True:
                at += 1; token = tokens[at]
                first = ends[at + 1] - len(token)
                match10 = REGEX7(text, ends[at + 1] - len(token))
                if match10 is None: at = before8; token = tokens[at]; unit_ = before9; break
                end = match10.end()
                while ends[at] < end: at += 1
                if ends[at] > end: at = before8; token = tokens[at]; unit_ = before9; break
                token = tokens[at]
                value = new_word(Word, match10[0])
                value.span = new_span(Span, (source, first, ends[at]))
                unit_ = value
                break
        made = new_node(TypeRef)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.bound = bound_
        made.array = array_
        made.unit = unit_
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
                match4 = REGEX8(text, ends[at + 1] - len(token))
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

    def r_DeliverySetting():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        if find('\n', ends[at], start) < 0: inline[at] = ','
        kind_ = None
        value_ = None
        if token in SET16:
            taken1 = token; at += 1; token = tokens[at]
            kind_ = taken1
        elif token == 'best':
            at += 1; token = tokens[at]
            kind_ = 'best'
            if not (token == 'effort'): return None
            at += 1; token = tokens[at]
        elif token in SET17:
            taken2 = token; at += 1; token = tokens[at]
            kind_ = taken2
            found = expression(at)
            if found is None: return None
            value, at = found; token = tokens[at]
            value_ = value
        else: return None
        made = new_node(DeliverySetting)
        made.span = new_span(Span, (source, start, ends[at]))
        made.kind = kind_
        made.value = value_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_Each():
        nonlocal at, token
        start = ends[at + 1] - 4
        role_ = None
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_node(Ref)
        value.name = taken1
        value.kind = 'Role'
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        value.target = None
        role_ = value
        if not (token == ':'): return None
        at += 1; token = tokens[at]
        made = new_node(Each)
        made.span = new_span(Span, (source, start, ends[at]))
        made.role = role_
        return made

    def r_PropertyScope():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        kind_ = ''
        start_ = None
        end_ = None
        first_ = None
        last_ = None
        if token == 'after':
            at += 1; token = tokens[at]
            kind_ = 'after'
            value = r_Claim()
            if value is None: return None
            start_ = value
            if token == 'until':
                before1 = at
                before2 = end_
                while True:
                    at += 1; token = tokens[at]
                    value = r_Claim()
                    if value is None: at = before1; token = tokens[at]; end_ = before2; break
                    end_ = value
                    break
            if not (token == ','): return None
            at += 1; token = tokens[at]
        elif token == 'before':
            at += 1; token = tokens[at]
            kind_ = 'before'
            value = r_Claim()
            if value is None: return None
            end_ = value
            if not (token == ','): return None
            at += 1; token = tokens[at]
        elif token == 'between':
            at += 1; token = tokens[at]
            kind_ = 'between'
            value = r_Term()
            if value is None: return None
            first_ = value
            if not (token == 'and'): return None
            at += 1; token = tokens[at]
            value = r_Term()
            if value is None: return None
            last_ = value
            if not (token == ','): return None
            at += 1; token = tokens[at]
        else: return None
        made = new_node(PropertyScope)
        made.span = new_span(Span, (source, start, ends[at]))
        made.kind = kind_
        made.start = start_
        made.end = end_
        made.first = first_
        made.last = last_
        return made

    def r_Pattern():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        kind_ = ''
        claim_ = None
        within_ = None
        times_ = None
        other_ = None
        later_ = []
        chosen1 = False
        if not chosen1 and token == 'never':
            before2 = at
            before3 = kind_
            before4 = claim_
            while True:
                at += 1; token = tokens[at]
                kind_ = 'never'
                value = r_Claim()
                if value is None: at = before2; token = tokens[at]; kind_ = before3; claim_ = before4; break
                claim_ = value
                chosen1 = True
                break
        if not chosen1 and token == 'eventually':
            before5 = at
            before6 = kind_
            before7 = claim_
            before8 = within_
            while True:
                at += 1; token = tokens[at]
                kind_ = 'eventually'
                value = r_Claim()
                if value is None: at = before5; token = tokens[at]; kind_ = before6; claim_ = before7; within_ = before8; break
                claim_ = value
                if token == 'within':
                    before9 = at
                    before10 = within_
                    while True:
                        at += 1; token = tokens[at]
                        found = delay(at)
                        if found is None: at = before9; token = tokens[at]; within_ = before10; break
                        value, at = found; token = tokens[at]
                        within_ = value
                        break
                chosen1 = True
                break
        if not chosen1 and token == 'always':
            before11 = at
            before12 = kind_
            before13 = claim_
            while True:
                at += 1; token = tokens[at]
                kind_ = 'always'
                if not (token == 'possible'): at = before11; token = tokens[at]; kind_ = before12; claim_ = before13; break
                at += 1; token = tokens[at]
                value = r_Claim()
                if value is None: at = before11; token = tokens[at]; kind_ = before12; claim_ = before13; break
                claim_ = value
                chosen1 = True
                break
        if not chosen1 and token == 'again':
            before14 = at
            before15 = kind_
            before16 = claim_
            while True:
                at += 1; token = tokens[at]
                kind_ = 'again'
                if not (token == 'and'): at = before14; token = tokens[at]; kind_ = before15; claim_ = before16; break
                at += 1; token = tokens[at]
                if not (token == 'again'): at = before14; token = tokens[at]; kind_ = before15; claim_ = before16; break
                at += 1; token = tokens[at]
                value = r_Claim()
                if value is None: at = before14; token = tokens[at]; kind_ = before15; claim_ = before16; break
                claim_ = value
                chosen1 = True
                break
        if not chosen1 and token not in SET18:
            before17 = at
            before18 = claim_
            before19 = kind_
            before20 = times_
            before21 = other_
            before22 = within_
            before23 = len(later_)
            while True:
                value = r_Claim()
                if value is None: at = before17; token = tokens[at]; claim_ = before18; kind_ = before19; times_ = before20; other_ = before21; within_ = before22; del later_[before23:]; break
                claim_ = value
                chosen24 = False
                if not chosen24 and token == 'at':
                    before25 = at
                    before26 = kind_
                    while True:
                        at += 1; token = tokens[at]
                        kind_ = 'at'
                        if not (token == 'all'): at = before25; token = tokens[at]; kind_ = before26; break
                        at += 1; token = tokens[at]
                        if not (token == 'times'): at = before25; token = tokens[at]; kind_ = before26; break
                        at += 1; token = tokens[at]
                        chosen24 = True
                        break
                if not chosen24 and token == 'at':
                    before27 = at
                    before28 = kind_
                    before29 = times_
                    while True:
                        at += 1; token = tokens[at]
                        kind_ = 'at'
                        if not (token == 'most'): at = before27; token = tokens[at]; kind_ = before28; times_ = before29; break
                        at += 1; token = tokens[at]
                        match30 = REGEX9(text, ends[at + 1] - len(token))
                        if match30 is None: at = before27; token = tokens[at]; kind_ = before28; times_ = before29; break
                        end = match30.end()
                        while ends[at] < end: at += 1
                        if ends[at] > end: at = before27; token = tokens[at]; kind_ = before28; times_ = before29; break
                        token = tokens[at]
                        times_ = match30[0]
                        if not (token == 'times'): at = before27; token = tokens[at]; kind_ = before28; times_ = before29; break
                        at += 1; token = tokens[at]
                        chosen24 = True
                        break
                if not chosen24 and token == 'leads':
                    before31 = at
                    before32 = kind_
                    before33 = other_
                    before34 = within_
                    while True:
                        at += 1; token = tokens[at]
                        kind_ = 'leads'
                        if not (token == 'to'): at = before31; token = tokens[at]; kind_ = before32; other_ = before33; within_ = before34; break
                        at += 1; token = tokens[at]
                        value = r_Claim()
                        if value is None: at = before31; token = tokens[at]; kind_ = before32; other_ = before33; within_ = before34; break
                        other_ = value
                        if token == 'within':
                            before35 = at
                            before36 = within_
                            while True:
                                at += 1; token = tokens[at]
                                found = delay(at)
                                if found is None: at = before35; token = tokens[at]; within_ = before36; break
                                value, at = found; token = tokens[at]
                                within_ = value
                                break
                        chosen24 = True
                        break
                if not chosen24 and token == 'only':
                    before37 = at
                    before38 = kind_
                    before39 = other_
                    while True:
                        at += 1; token = tokens[at]
                        kind_ = 'only'
                        if not (token == 'after'): at = before37; token = tokens[at]; kind_ = before38; other_ = before39; break
                        at += 1; token = tokens[at]
                        value = r_Claim()
                        if value is None: at = before37; token = tokens[at]; kind_ = before38; other_ = before39; break
                        other_ = value
                        chosen24 = True
                        break
                if not chosen24 and token == 'then':
                    before40 = at
                    before41 = kind_
                    before42 = len(later_)
                    while True:
                        at += 1; token = tokens[at]
                        kind_ = 'then'
                        value = r_Claim()
                        if value is None: at = before40; token = tokens[at]; kind_ = before41; del later_[before42:]; break
                        later_.append(value)
                        while token == 'then':
                            before43 = at
                            at += 1; token = tokens[at]
                            value = r_Claim()
                            if value is None: at = before43; token = tokens[at]; break
                            later_.append(value)
                        chosen24 = True
                        break
                if not chosen24 and token == 'within':
                    before44 = at
                    before45 = kind_
                    before46 = within_
                    while True:
                        at += 1; token = tokens[at]
                        kind_ = 'within'
                        found = delay(at)
                        if found is None: at = before44; token = tokens[at]; kind_ = before45; within_ = before46; break
                        value, at = found; token = tokens[at]
                        within_ = value
                        chosen24 = True
                        break
                if not chosen24: at = before17; token = tokens[at]; claim_ = before18; kind_ = before19; times_ = before20; other_ = before21; within_ = before22; del later_[before23:]; break
                chosen1 = True
                break
        if not chosen1: return None
        made = new_node(Pattern)
        made.span = new_span(Span, (source, start, ends[at]))
        made.kind = kind_
        made.claim = claim_
        made.times = times_
        made.other = other_
        made.later = later_
        made.within = within_
        return made

    def r_Chance():
        nonlocal at, token
        start = ends[at + 1] - 2
        bound_ = None
        probability_ = None
        at += 1; token = tokens[at]
        if not (token in SET19): return None
        taken1 = token; at += 1; token = tokens[at]
        bound_ = taken1
        match2 = REGEX10(text, ends[at + 1] - len(token))
        if match2 is None: return None
        end = match2.end()
        while ends[at] < end: at += 1
        if ends[at] > end: return None
        token = tokens[at]
        probability_ = match2[0]
        made = new_node(Chance)
        made.span = new_span(Span, (source, start, ends[at]))
        made.bound = bound_
        made.probability = probability_
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

    def r_SubjectTo():
        nonlocal at, token
        start = ends[at + 1] - 7
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        property_ = None
        at += 1; token = tokens[at]
        if not (token == 'to'): return None
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
        value.kind = 'Property'
        value.span = new_span(Span, (source, first, first + len(text1)))
        value.target = None
        property_ = value
        made = new_node(SubjectTo)
        made.span = new_span(Span, (source, start, ends[at]))
        made.property = property_
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

    def r_ModelUse():
        nonlocal at, token
        start = ends[at + 1] - 5
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        arguments_ = []
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if token == '(':
            before2 = at
            before3 = len(arguments_)
            while True:
                at += 1; token = tokens[at]
                if token >= 'A' and token not in SET3:
                    before4 = at
                    while True:
                        value = r_Argument()
                        if value is None: at = before4; token = tokens[at]; break
                        arguments_.append(value)
                        while token == ',':
                            before5 = at
                            at += 1; token = tokens[at]
                            value = r_Argument()
                            if value is None: at = before5; token = tokens[at]; break
                            arguments_.append(value)
                        break
                if not (token == ')'): at = before2; token = tokens[at]; del arguments_[before3:]; break
                at += 1; token = tokens[at]
                break
        made = new_node(ModelUse)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.arguments = arguments_
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
        match2 = REGEX11(text, ends[at + 1] - len(token))
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

    def r_Sight():
        nonlocal at, token
        start = ends[at + 1] - 6
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        target_ = None
        values_ = []
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET3): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_node(Ref)
        value.name = taken1
        value.kind = 'Targets'
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        value.target = None
        target_ = value
        if token == '{':
            before2 = at
            before3 = len(values_)
            while True:
                at += 1; token = tokens[at]
                while token >= 'A' and token not in SET3:
                    before4 = at
                    before5 = len(values_)
                    value = r_PartValue()
                    if value is None: at = before4; token = tokens[at]; del values_[before5:]; break
                    values_.append(value)
                    if token in SET4:
                        at += 1; token = tokens[at]
                if not (token == '}'): at = before2; token = tokens[at]; del values_[before3:]; break
                at += 1; token = tokens[at]
                break
        made = new_node(Sight)
        made.span = new_span(Span, (source, start, ends[at]))
        made.target = target_
        made.values = values_
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

    def r_Equipment():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        kind_ = None
        values_ = []
        taken1 = token; at += 1; token = tokens[at]
        kind_ = taken1
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
        made = new_node(Equipment)
        made.span = new_span(Span, (source, start, ends[at]))
        made.kind = kind_
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

    def r_Contract():
        nonlocal at, token
        start = ends[at + 1] - 8
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        triggers_ = []
        guard_ = None
        within_ = None
        states_ = []
        function_ = None
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if not (token == ':'): return None
        at += 1; token = tokens[at]
        if token == 'on':
            at += 1; token = tokens[at]
            value = r_EventTrigger()
            if value is None: return None
            triggers_.append(value)
            while token == ',':
                before2 = at
                at += 1; token = tokens[at]
                value = r_EventTrigger()
                if value is None: at = before2; token = tokens[at]; break
                triggers_.append(value)
            if token == '[':
                before3 = at
                before4 = guard_
                while True:
                    at += 1; token = tokens[at]
                    found = expression(at)
                    if found is None: at = before3; token = tokens[at]; guard_ = before4; break
                    value, at = found; token = tokens[at]
                    guard_ = value
                    if not (token == ']'): at = before3; token = tokens[at]; guard_ = before4; break
                    at += 1; token = tokens[at]
                    break
            if not (token == 'within'): return None
            at += 1; token = tokens[at]
            found = delay(at)
            if found is None: return None
            value, at = found; token = tokens[at]
            within_ = value
            if not (token == 'reach'): return None
            at += 1; token = tokens[at]
            value = r_SafeState()
            if value is None: return None
            states_.append(value)
            while token == ',':
                before5 = at
                at += 1; token = tokens[at]
                value = r_SafeState()
                if value is None: at = before5; token = tokens[at]; break
                states_.append(value)
        elif token == 'when':
            at += 1; token = tokens[at]
            if not (token == 'dead'): return None
            at += 1; token = tokens[at]
            if not (token == 'call'): return None
            at += 1; token = tokens[at]
            first = ends[at + 1] - len(token)
            if not (token >= 'A' and token not in SET2): return None
            taken7 = token; at += 1; token = tokens[at]
            text6 = taken7
            if token == '.':
                match8 = REGEX0(text, ends[at + 1] - len(token))
                if match8[0]:
                    text6 += match8[0]
                    end = match8.end()
                    while ends[at] < end: at += 1
                    if ends[at] > end: return None
                    token = tokens[at]
            value = new_node(Ref)
            value.name = text6
            value.kind = 'Function'
            value.span = new_span(Span, (source, first, first + len(text6)))
            value.target = None
            function_ = value
        else: return None
        made = new_node(Contract)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.triggers = triggers_
        made.guard = guard_
        made.within = within_
        made.states = states_
        made.function = function_
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

    def r_Heartbeat():
        nonlocal at, token
        start = ends[at + 1] - 9
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        period_ = None
        timeout_ = None
        at += 1; token = tokens[at]
        found = expression(at)
        if found is None: return None
        value, at = found; token = tokens[at]
        period_ = value
        if not (token == 'lost'): return None
        at += 1; token = tokens[at]
        if not (token == 'after'): return None
        at += 1; token = tokens[at]
        found = expression(at)
        if found is None: return None
        value, at = found; token = tokens[at]
        timeout_ = value
        made = new_node(Heartbeat)
        made.span = new_span(Span, (source, start, ends[at]))
        made.period = period_
        made.timeout = timeout_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_Role():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        member_ = None
        multiplicity_ = None
        start_ = None
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
        if token in SET20:
            before7 = at
            while True:
                value = r_Start()
                if value is None: at = before7; token = tokens[at]; break
                start_ = value
                break
        if token == '{':
            before8 = at
            before9 = len(values_)
            while True:
                at += 1; token = tokens[at]
                while token >= 'A' and token not in SET3:
                    before10 = at
                    before11 = len(values_)
                    value = r_PartValue()
                    if value is None: at = before10; token = tokens[at]; del values_[before11:]; break
                    values_.append(value)
                    if token in SET4:
                        at += 1; token = tokens[at]
                if not (token == '}'): at = before8; token = tokens[at]; del values_[before9:]; break
                at += 1; token = tokens[at]
                break
        made = new_node(Role)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.member = member_
        made.multiplicity = multiplicity_
        made.start = start_
        made.values = values_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_RobotValues():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        role_ = None
        index_ = None
        start_ = None
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
        if token in SET20:
            value = r_Start()
            if value is None: return None
            start_ = value
            if token == '{':
                before3 = at
                before4 = len(values_)
                while True:
                    at += 1; token = tokens[at]
                    while token >= 'A' and token not in SET3:
                        before5 = at
                        before6 = len(values_)
                        value = r_PartValue()
                        if value is None: at = before5; token = tokens[at]; del values_[before6:]; break
                        values_.append(value)
                        if token in SET4:
                            at += 1; token = tokens[at]
                    if not (token == '}'): at = before3; token = tokens[at]; del values_[before4:]; break
                    at += 1; token = tokens[at]
                    break
        elif token == '{':
            at += 1; token = tokens[at]
            while token >= 'A' and token not in SET3:
                before7 = at
                before8 = len(values_)
                value = r_PartValue()
                if value is None: at = before7; token = tokens[at]; del values_[before8:]; break
                values_.append(value)
                if token in SET4:
                    at += 1; token = tokens[at]
            if not (token == '}'): return None
            at += 1; token = tokens[at]
        else: return None
        made = new_node(RobotValues)
        made.span = new_span(Span, (source, start, ends[at]))
        made.role = role_
        made.index = index_
        made.start = start_
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
        match1 = REGEX12(text, ends[at + 1] - len(token))
        if match1 is None: return None
        end = match1.end()
        while ends[at] < end: at += 1
        if ends[at] > end: return None
        token = tokens[at]
        width_ = match1[0]
        if not (token == 'x'): return None
        at += 1; token = tokens[at]
        match2 = REGEX12(text, ends[at + 1] - len(token))
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
                match5 = REGEX12(text, ends[at + 1] - len(token))
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

    def r_Area():
        nonlocal at, token
        start = ends[at + 1] - 4
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        box_ = None
        height_ = None
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if not (token == ':'): return None
        at += 1; token = tokens[at]
        if not (token == '('): return None
        value = r_Box()
        if value is None: return None
        box_ = value
        if token == 'height':
            before2 = at
            while True:
                value = r_Height()
                if value is None: at = before2; token = tokens[at]; break
                height_ = value
                break
        made = new_node(Area)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.box = box_
        made.height = height_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_Zone():
        nonlocal at, token
        start = ends[at + 1] - 4
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        box_ = None
        height_ = None
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if not (token == ':'): return None
        at += 1; token = tokens[at]
        if not (token == '('): return None
        value = r_Box()
        if value is None: return None
        box_ = value
        if token == 'height':
            before2 = at
            while True:
                value = r_Height()
                if value is None: at = before2; token = tokens[at]; break
                height_ = value
                break
        made = new_node(Zone)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.box = box_
        made.height = height_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_Wall():
        nonlocal at, token
        start = ends[at + 1] - 4
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        points_ = []
        height_ = None
        at += 1; token = tokens[at]
        if not (token == ':'): return None
        at += 1; token = tokens[at]
        if not (token == '('): return None
        value = r_Point()
        if value is None: return None
        points_.append(value)
        while token == '-':
            before1 = at
            if not (token == '-' and tokens[at + 1] == '>' and ends[at + 2] == ends[at + 1] + 1): at = before1; token = tokens[at]; break
            at += 2; token = tokens[at]
            if not (token == '('): at = before1; token = tokens[at]; break
            value = r_Point()
            if value is None: at = before1; token = tokens[at]; break
            points_.append(value)
        if token == 'height':
            before2 = at
            while True:
                value = r_Height()
                if value is None: at = before2; token = tokens[at]; break
                height_ = value
                break
        made = new_node(Wall)
        made.span = new_span(Span, (source, start, ends[at]))
        made.points = points_
        made.height = height_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_Obstacle():
        nonlocal at, token
        start = ends[at + 1] - 8
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        corner_ = None
        opposite_ = None
        radius_ = None
        height_ = None
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET2): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if not (token == ':'): return None
        at += 1; token = tokens[at]
        if not (token == '('): return None
        value = r_Point()
        if value is None: return None
        corner_ = value
        if token == '.':
            if not (token == '.' and tokens[at + 1] == '.' and ends[at + 2] == ends[at + 1] + 1): return None
            at += 2; token = tokens[at]
            if not (token == '('): return None
            value = r_Point()
            if value is None: return None
            opposite_ = value
        elif token == 'radius':
            at += 1; token = tokens[at]
            found = expression(at)
            if found is None: return None
            value, at = found; token = tokens[at]
            radius_ = value
        else: return None
        if token == 'height':
            before2 = at
            while True:
                value = r_Height()
                if value is None: at = before2; token = tokens[at]; break
                height_ = value
                break
        made = new_node(Obstacle)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.corner = corner_
        made.opposite = opposite_
        made.radius = radius_
        made.height = height_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_Targets():
        nonlocal at, token
        start = ends[at + 1] - 6
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        count_ = None
        area_ = None
        places_ = []
        at += 1; token = tokens[at]
        if not (token >= 'A' and token not in SET3): return None
        taken1 = token; at += 1; token = tokens[at]
        value = new_word(Word, taken1)
        value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
        name_ = value
        if token == '[':
            before2 = at
            before3 = count_
            while True:
                at += 1; token = tokens[at]
                match4 = REGEX9(text, ends[at + 1] - len(token))
                if match4 is None: at = before2; token = tokens[at]; count_ = before3; break
                end = match4.end()
                while ends[at] < end: at += 1
                if ends[at] > end: at = before2; token = tokens[at]; count_ = before3; break
                token = tokens[at]
                count_ = match4[0]
                if not (token == ']'): at = before2; token = tokens[at]; count_ = before3; break
                at += 1; token = tokens[at]
                break
        if not (token == 'at'): return None
        at += 1; token = tokens[at]
        if token == 'random':
            at += 1; token = tokens[at]
            if token == 'in':
                before5 = at
                before6 = area_
                while True:
                    at += 1; token = tokens[at]
                    if not (token >= 'A' and token not in SET2): at = before5; token = tokens[at]; area_ = before6; break
                    taken7 = token; at += 1; token = tokens[at]
                    value = new_node(Ref)
                    value.name = taken7
                    value.kind = 'Area'
                    value.span = new_span(Span, (source, ends[at] - len(taken7), ends[at]))
                    value.target = None
                    area_ = value
                    break
        elif token == '(':
            value = r_Point()
            if value is None: return None
            places_.append(value)
            while token == ',':
                before8 = at
                at += 1; token = tokens[at]
                if not (token == '('): at = before8; token = tokens[at]; break
                value = r_Point()
                if value is None: at = before8; token = tokens[at]; break
                places_.append(value)
        else: return None
        made = new_node(Targets)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.count = count_
        made.area = area_
        made.places = places_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_Wind():
        nonlocal at, token
        start = ends[at + 1] - 4
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        speed_ = None
        angle_ = None
        start_ = None
        end_ = None
        at += 1; token = tokens[at]
        found = expression(at)
        if found is None: return None
        value, at = found; token = tokens[at]
        speed_ = value
        if not (token == 'to'): return None
        at += 1; token = tokens[at]
        found = expression(at)
        if found is None: return None
        value, at = found; token = tokens[at]
        angle_ = value
        if token == 'from':
            before1 = at
            before2 = start_
            while True:
                at += 1; token = tokens[at]
                found = expression(at)
                if found is None: at = before1; token = tokens[at]; start_ = before2; break
                value, at = found; token = tokens[at]
                start_ = value
                break
        if token == 'until':
            before3 = at
            before4 = end_
            while True:
                at += 1; token = tokens[at]
                found = expression(at)
                if found is None: at = before3; token = tokens[at]; end_ = before4; break
                value, at = found; token = tokens[at]
                end_ = value
                break
        made = new_node(Wind)
        made.span = new_span(Span, (source, start, ends[at]))
        made.speed = speed_
        made.angle = angle_
        made.start = start_
        made.end = end_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_Rain():
        nonlocal at, token
        start = ends[at + 1] - 4
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        start_ = None
        end_ = None
        at += 1; token = tokens[at]
        if token == 'from':
            before1 = at
            before2 = start_
            while True:
                at += 1; token = tokens[at]
                found = expression(at)
                if found is None: at = before1; token = tokens[at]; start_ = before2; break
                value, at = found; token = tokens[at]
                start_ = value
                break
        if token == 'until':
            before3 = at
            before4 = end_
            while True:
                at += 1; token = tokens[at]
                found = expression(at)
                if found is None: at = before3; token = tokens[at]; end_ = before4; break
                value, at = found; token = tokens[at]
                end_ = value
                break
        made = new_node(Rain)
        made.span = new_span(Span, (source, start, ends[at]))
        made.start = start_
        made.end = end_
        made.doc = docs.pop(start) if start in docs else ''
        return made

    def r_FitnessInput():
        nonlocal at, token
        start = ends[at + 1] - 2
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        name_ = None
        type_ = None
        space_ = None
        measure_ = None
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
            before3 = space_
            before4 = measure_
            while True:
                at += 1; token = tokens[at]
                if token in SET21:
                    value = r_SpaceMeasure()
                    if value is None: at = before2; token = tokens[at]; space_ = before3; measure_ = before4; break
                    space_ = value
                elif token in SET22:
                    value = r_Measure()
                    if value is None: at = before2; token = tokens[at]; space_ = before3; measure_ = before4; break
                    measure_ = value
                else: at = before2; token = tokens[at]; space_ = before3; measure_ = before4; break
                break
        made = new_node(FitnessInput)
        made.span = new_span(Span, (source, start, ends[at]))
        made.name = name_
        made.type = type_
        made.space = space_
        made.measure = measure_
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

    def r_Claim():
        nonlocal at, token, depth
        depth += 1
        if depth > limit: raise TooDeepError
        start = ends[at + 1] - len(token)
        any_ = []
        value = r_Conjunction()
        if value is None: depth -= 1; return None
        any_.append(value)
        while token == 'or':
            before1 = at
            at += 1; token = tokens[at]
            value = r_Conjunction()
            if value is None: at = before1; token = tokens[at]; break
            any_.append(value)
        depth -= 1
        made = new_node(Claim)
        made.span = new_span(Span, (source, start, ends[at]))
        made.any = any_
        return made

    def r_Term():
        nonlocal at, token, depth
        depth += 1
        if depth > limit: raise TooDeepError
        start = ends[at + 1] - len(token)
        negated_ = False
        claim_ = None
        fact_ = None
        if token == 'not':
            at += 1; token = tokens[at]
            negated_ = True
        if token == '(':
            at += 1; token = tokens[at]
            value = r_Claim()
            if value is None: depth -= 1; return None
            claim_ = value
            if not (token == ')'): depth -= 1; return None
            at += 1; token = tokens[at]
        elif token not in SET23:
            value = r_Fact()
            if value is None: depth -= 1; return None
            fact_ = value
        else: depth -= 1; return None
        depth -= 1
        made = new_node(Term)
        made.span = new_span(Span, (source, start, ends[at]))
        made.negated = negated_
        made.claim = claim_
        made.fact = fact_
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

    def r_Parameter():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        direction_ = None
        name_ = None
        type_ = None
        chosen1 = False
        if not chosen1 and token in SET24:
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
        match4 = REGEX11(text, ends[at + 1] - len(token))
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

    def r_SafeState():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        state_ = None
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
        state_ = value
        made = new_node(SafeState)
        made.span = new_span(Span, (source, start, ends[at]))
        made.state = state_
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
                while token in SET25:
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
        while token in SET26:
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
        while token in SET27:
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
        match1 = REGEX13(text, ends[at + 1] - len(token))
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
                match4 = REGEX13(text, ends[at + 1] - len(token))
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

    def r_Start():
        nonlocal at, token
        start = ends[at + 1] - 2
        area_ = None
        point_ = None
        if token == 'in':
            at += 1; token = tokens[at]
            if not (token >= 'A' and token not in SET2): return None
            taken1 = token; at += 1; token = tokens[at]
            value = new_node(Ref)
            value.name = taken1
            value.kind = 'Area'
            value.span = new_span(Span, (source, ends[at] - len(taken1), ends[at]))
            value.target = None
            area_ = value
        elif token == 'at':
            at += 1; token = tokens[at]
            if not (token == '('): return None
            value = r_Point()
            if value is None: return None
            point_ = value
        else: return None
        made = new_node(Start)
        made.span = new_span(Span, (source, start, ends[at]))
        made.area = area_
        made.point = point_
        return made

    def r_Box():
        nonlocal at, token
        start = ends[at + 1] - 1
        low_ = None
        high_ = None
        value = r_Point()
        if value is None: return None
        low_ = value
        if not (token == '.' and tokens[at + 1] == '.' and ends[at + 2] == ends[at + 1] + 1): return None
        at += 2; token = tokens[at]
        if not (token == '('): return None
        value = r_Point()
        if value is None: return None
        high_ = value
        made = new_node(Box)
        made.span = new_span(Span, (source, start, ends[at]))
        made.low = low_
        made.high = high_
        return made

    def r_Height():
        nonlocal at, token
        start = ends[at + 1] - 6
        lower_ = None
        upper_ = None
        at += 1; token = tokens[at]
        found = expression(at)
        if found is None: return None
        value, at = found; token = tokens[at]
        lower_ = value
        if token == '.':
            before1 = at
            before2 = upper_
            while True:
                if not (token == '.' and tokens[at + 1] == '.' and ends[at + 2] == ends[at + 1] + 1): at = before1; token = tokens[at]; upper_ = before2; break
                at += 2; token = tokens[at]
                found = expression(at)
                if found is None: at = before1; token = tokens[at]; upper_ = before2; break
                value, at = found; token = tokens[at]
                upper_ = value
                break
        made = new_node(Height)
        made.span = new_span(Span, (source, start, ends[at]))
        made.lower = lower_
        made.upper = upper_
        return made

    def r_Point():
        nonlocal at, token
        start = ends[at + 1] - 1
        x_ = None
        y_ = None
        at += 1; token = tokens[at]
        found = expression(at)
        if found is None: return None
        value, at = found; token = tokens[at]
        x_ = value
        if not (token == ','): return None
        at += 1; token = tokens[at]
        found = expression(at)
        if found is None: return None
        value, at = found; token = tokens[at]
        y_ = value
        if not (token == ')'): return None
        at += 1; token = tokens[at]
        made = new_node(Point)
        made.span = new_span(Span, (source, start, ends[at]))
        made.x = x_
        made.y = y_
        return made

    def r_SpaceMeasure():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        quantity_ = None
        role_ = None
        target_ = None
        if token in SET28:
            taken1 = token; at += 1; token = tokens[at]
            quantity_ = taken1
            if not (token == '('): return None
            at += 1; token = tokens[at]
            if not (token >= 'A' and token not in SET2): return None
            taken2 = token; at += 1; token = tokens[at]
            value = new_node(Ref)
            value.name = taken2
            value.kind = 'Role'
            value.span = new_span(Span, (source, ends[at] - len(taken2), ends[at]))
            value.target = None
            role_ = value
            if not (token == ')'): return None
            at += 1; token = tokens[at]
        elif token == 'found':
            at += 1; token = tokens[at]
            quantity_ = 'found'
            if not (token == '('): return None
            at += 1; token = tokens[at]
            if not (token >= 'A' and token not in SET3): return None
            taken3 = token; at += 1; token = tokens[at]
            value = new_node(Ref)
            value.name = taken3
            value.kind = 'Targets'
            value.span = new_span(Span, (source, ends[at] - len(taken3), ends[at]))
            value.target = None
            target_ = value
            if not (token == ')'): return None
            at += 1; token = tokens[at]
        else: return None
        made = new_node(SpaceMeasure)
        made.span = new_span(Span, (source, start, ends[at]))
        made.quantity = quantity_
        made.role = role_
        made.target = target_
        return made

    def r_Measure():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        aggregate_ = None
        each_ = None
        kind_ = ''
        claim_ = None
        until_ = ''
        over_ = None
        if token in SET29:
            before1 = at
            before2 = aggregate_
            before3 = each_
            while True:
                taken4 = token; at += 1; token = tokens[at]
                aggregate_ = taken4
                if not (token == 'each'): at = before1; token = tokens[at]; aggregate_ = before2; each_ = before3; break
                value = r_Each()
                if value is None: at = before1; token = tokens[at]; aggregate_ = before2; each_ = before3; break
                each_ = value
                break
        if token == 'count':
            at += 1; token = tokens[at]
            kind_ = 'count'
            if not (token == '('): return None
            at += 1; token = tokens[at]
            value = r_Claim()
            if value is None: return None
            claim_ = value
            if not (token == ')'): return None
            at += 1; token = tokens[at]
        elif token == 'total':
            at += 1; token = tokens[at]
            kind_ = 'total'
            if not (token == '('): return None
            at += 1; token = tokens[at]
            value = r_Claim()
            if value is None: return None
            claim_ = value
            if not (token == ')'): return None
            at += 1; token = tokens[at]
        elif token == 'time':
            at += 1; token = tokens[at]
            kind_ = 'time'
            if token == 'until':
                at += 1; token = tokens[at]
                until_ = 'until'
                value = r_Claim()
                if value is None: return None
                claim_ = value
            elif token == '(':
                at += 1; token = tokens[at]
                value = r_Claim()
                if value is None: return None
                claim_ = value
                if not (token == ')'): return None
                at += 1; token = tokens[at]
            else: return None
        elif token in SET30:
            taken5 = token; at += 1; token = tokens[at]
            over_ = taken5
            if not (token == 'count'): return None
            at += 1; token = tokens[at]
            kind_ = 'count'
            if not (token == '('): return None
            at += 1; token = tokens[at]
            value = r_Claim()
            if value is None: return None
            claim_ = value
            if not (token == ')'): return None
            at += 1; token = tokens[at]
        else: return None
        made = new_node(Measure)
        made.span = new_span(Span, (source, start, ends[at]))
        made.aggregate = aggregate_
        made.each = each_
        made.kind = kind_
        made.claim = claim_
        made.until = until_
        made.over = over_
        made.about = None
        return made

    def r_Conjunction():
        nonlocal at, token, depth
        depth += 1
        if depth > limit: raise TooDeepError
        start = ends[at + 1] - len(token)
        all_ = []
        value = r_Term()
        if value is None: depth -= 1; return None
        all_.append(value)
        while token == 'and':
            before1 = at
            at += 1; token = tokens[at]
            value = r_Term()
            if value is None: at = before1; token = tokens[at]; break
            all_.append(value)
        depth -= 1
        made = new_node(Conjunction)
        made.span = new_span(Span, (source, start, ends[at]))
        made.all = all_
        return made

    def r_Fact():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        counted_ = None
        state_ = None
        comparison_ = None
        number_ = None
        guard_ = None
        act_ = None
        event_ = None
        function_ = None
        outcome_ = None
        who_ = None
        chosen1 = False
        if not chosen1 and token == 'count':
            before2 = at
            before3 = counted_
            before4 = state_
            before5 = comparison_
            before6 = number_
            while True:
                at += 1; token = tokens[at]
                if not (token == '('): at = before2; token = tokens[at]; counted_ = before3; state_ = before4; comparison_ = before5; number_ = before6; break
                at += 1; token = tokens[at]
                if not (token >= 'A' and token not in SET2): at = before2; token = tokens[at]; counted_ = before3; state_ = before4; comparison_ = before5; number_ = before6; break
                taken7 = token; at += 1; token = tokens[at]
                value = new_node(Ref)
                value.name = taken7
                value.kind = 'Role'
                value.span = new_span(Span, (source, ends[at] - len(taken7), ends[at]))
                value.target = None
                counted_ = value
                if not (token == 'in'): at = before2; token = tokens[at]; counted_ = before3; state_ = before4; comparison_ = before5; number_ = before6; break
                at += 1; token = tokens[at]
                first = ends[at + 1] - len(token)
                if not (token >= 'A' and token not in SET2): at = before2; token = tokens[at]; counted_ = before3; state_ = before4; comparison_ = before5; number_ = before6; break
                taken9 = token; at += 1; token = tokens[at]
                text8 = taken9
                if token == '.':
                    match10 = REGEX0(text, ends[at + 1] - len(token))
                    if match10[0]:
                        text8 += match10[0]
                        end = match10.end()
                        while ends[at] < end: at += 1
                        if ends[at] > end: at = before2; token = tokens[at]; counted_ = before3; state_ = before4; comparison_ = before5; number_ = before6; break
                        token = tokens[at]
                value = new_node(Ref)
                value.name = text8
                value.kind = 'Vertex'
                value.span = new_span(Span, (source, first, first + len(text8)))
                value.target = None
                state_ = value
                if not (token == ')'): at = before2; token = tokens[at]; counted_ = before3; state_ = before4; comparison_ = before5; number_ = before6; break
                at += 1; token = tokens[at]
                match11 = REGEX14(text, ends[at + 1] - len(token))
                if match11 is None: at = before2; token = tokens[at]; counted_ = before3; state_ = before4; comparison_ = before5; number_ = before6; break
                end = match11.end()
                while ends[at] < end: at += 1
                if ends[at] > end: at = before2; token = tokens[at]; counted_ = before3; state_ = before4; comparison_ = before5; number_ = before6; break
                token = tokens[at]
                comparison_ = match11[0]
                match12 = REGEX9(text, ends[at + 1] - len(token))
                if match12 is None: at = before2; token = tokens[at]; counted_ = before3; state_ = before4; comparison_ = before5; number_ = before6; break
                end = match12.end()
                while ends[at] < end: at += 1
                if ends[at] > end: at = before2; token = tokens[at]; counted_ = before3; state_ = before4; comparison_ = before5; number_ = before6; break
                token = tokens[at]
                number_ = match12[0]
                chosen1 = True
                break
        if not chosen1 and token == 'in':
            before13 = at
            before14 = state_
            while True:
                at += 1; token = tokens[at]
                first = ends[at + 1] - len(token)
                if not (token >= 'A' and token not in SET2): at = before13; token = tokens[at]; state_ = before14; break
                taken16 = token; at += 1; token = tokens[at]
                text15 = taken16
                if token == '.':
                    match17 = REGEX0(text, ends[at + 1] - len(token))
                    if match17[0]:
                        text15 += match17[0]
                        end = match17.end()
                        while ends[at] < end: at += 1
                        if ends[at] > end: at = before13; token = tokens[at]; state_ = before14; break
                        token = tokens[at]
                value = new_node(Ref)
                value.name = text15
                value.kind = 'Vertex'
                value.span = new_span(Span, (source, first, first + len(text15)))
                value.target = None
                state_ = value
                chosen1 = True
                break
        if not chosen1 and token == 'has':
            before18 = at
            before19 = guard_
            while True:
                at += 1; token = tokens[at]
                if not (token == '['): at = before18; token = tokens[at]; guard_ = before19; break
                at += 1; token = tokens[at]
                found = expression(at)
                if found is None: at = before18; token = tokens[at]; guard_ = before19; break
                value, at = found; token = tokens[at]
                guard_ = value
                if not (token == ']'): at = before18; token = tokens[at]; guard_ = before19; break
                at += 1; token = tokens[at]
                chosen1 = True
                break
        if not chosen1 and token in SET31:
            before20 = at
            before21 = act_
            before22 = event_
            before23 = guard_
            while True:
                taken24 = token; at += 1; token = tokens[at]
                act_ = taken24
                first = ends[at + 1] - len(token)
                if not (token >= 'A' and token not in SET2): at = before20; token = tokens[at]; act_ = before21; event_ = before22; guard_ = before23; break
                taken26 = token; at += 1; token = tokens[at]
                text25 = taken26
                if token == '.':
                    match27 = REGEX0(text, ends[at + 1] - len(token))
                    if match27[0]:
                        text25 += match27[0]
                        end = match27.end()
                        while ends[at] < end: at += 1
                        if ends[at] > end: at = before20; token = tokens[at]; act_ = before21; event_ = before22; guard_ = before23; break
                        token = tokens[at]
                value = new_node(Ref)
                value.name = text25
                value.kind = 'Event'
                value.span = new_span(Span, (source, first, first + len(text25)))
                value.target = None
                event_ = value
                if token == '[':
                    before28 = at
                    before29 = guard_
                    while True:
                        at += 1; token = tokens[at]
                        found = expression(at)
                        if found is None: at = before28; token = tokens[at]; guard_ = before29; break
                        value, at = found; token = tokens[at]
                        guard_ = value
                        if not (token == ']'): at = before28; token = tokens[at]; guard_ = before29; break
                        at += 1; token = tokens[at]
                        break
                chosen1 = True
                break
        if not chosen1 and token in SET32:
            before30 = at
            before31 = act_
            before32 = function_
            while True:
                taken33 = token; at += 1; token = tokens[at]
                act_ = taken33
                first = ends[at + 1] - len(token)
                if not (token >= 'A' and token not in SET2): at = before30; token = tokens[at]; act_ = before31; function_ = before32; break
                taken35 = token; at += 1; token = tokens[at]
                text34 = taken35
                if token == '.':
                    match36 = REGEX0(text, ends[at + 1] - len(token))
                    if match36[0]:
                        text34 += match36[0]
                        end = match36.end()
                        while ends[at] < end: at += 1
                        if ends[at] > end: at = before30; token = tokens[at]; act_ = before31; function_ = before32; break
                        token = tokens[at]
                value = new_node(Ref)
                value.name = text34
                value.kind = 'Function'
                value.span = new_span(Span, (source, first, first + len(text34)))
                value.target = None
                function_ = value
                chosen1 = True
                break
        if not chosen1 and token == 'ends':
            before37 = at
            before38 = act_
            before39 = function_
            before40 = outcome_
            while True:
                at += 1; token = tokens[at]
                act_ = 'ends'
                first = ends[at + 1] - len(token)
                if not (token >= 'A' and token not in SET2): at = before37; token = tokens[at]; act_ = before38; function_ = before39; outcome_ = before40; break
                taken42 = token; at += 1; token = tokens[at]
                text41 = taken42
                if token == '.':
                    match43 = REGEX0(text, ends[at + 1] - len(token))
                    if match43[0]:
                        text41 += match43[0]
                        end = match43.end()
                        while ends[at] < end: at += 1
                        if ends[at] > end: at = before37; token = tokens[at]; act_ = before38; function_ = before39; outcome_ = before40; break
                        token = tokens[at]
                value = new_node(Ref)
                value.name = text41
                value.kind = 'Function'
                value.span = new_span(Span, (source, first, first + len(text41)))
                value.target = None
                function_ = value
                if token == 'as':
                    before44 = at
                    before45 = outcome_
                    while True:
                        at += 1; token = tokens[at]
                        if not (token in SET33): at = before44; token = tokens[at]; outcome_ = before45; break
                        taken46 = token; at += 1; token = tokens[at]
                        outcome_ = taken46
                        break
                chosen1 = True
                break
        if not chosen1 and token not in SET34:
            before47 = at
            before48 = who_
            before49 = state_
            before50 = guard_
            before51 = act_
            before52 = event_
            before53 = function_
            before54 = outcome_
            while True:
                value = r_Who()
                if value is None: at = before47; token = tokens[at]; who_ = before48; state_ = before49; guard_ = before50; act_ = before51; event_ = before52; function_ = before53; outcome_ = before54; break
                who_ = value
                if token == 'in':
                    at += 1; token = tokens[at]
                    first = ends[at + 1] - len(token)
                    if not (token >= 'A' and token not in SET2): at = before47; token = tokens[at]; who_ = before48; state_ = before49; guard_ = before50; act_ = before51; event_ = before52; function_ = before53; outcome_ = before54; break
                    taken57 = token; at += 1; token = tokens[at]
                    text56 = taken57
                    if token == '.':
                        match58 = REGEX0(text, ends[at + 1] - len(token))
                        if match58[0]:
                            text56 += match58[0]
                            end = match58.end()
                            while ends[at] < end: at += 1
                            if ends[at] > end: at = before47; token = tokens[at]; who_ = before48; state_ = before49; guard_ = before50; act_ = before51; event_ = before52; function_ = before53; outcome_ = before54; break
                            token = tokens[at]
                    text55 = text56
                    if REGEX15(text, ends[at + 1] - len(token)) is None: at = before47; token = tokens[at]; who_ = before48; state_ = before49; guard_ = before50; act_ = before51; event_ = before52; function_ = before53; outcome_ = before54; break
                    value = new_node(Ref)
                    value.name = text55
                    value.kind = 'Vertex'
                    value.span = new_span(Span, (source, first, first + len(text55)))
                    value.target = None
                    state_ = value
                elif token == 'has':
                    at += 1; token = tokens[at]
                    if not (token == '['): at = before47; token = tokens[at]; who_ = before48; state_ = before49; guard_ = before50; act_ = before51; event_ = before52; function_ = before53; outcome_ = before54; break
                    at += 1; token = tokens[at]
                    found = expression(at)
                    if found is None: at = before47; token = tokens[at]; who_ = before48; state_ = before49; guard_ = before50; act_ = before51; event_ = before52; function_ = before53; outcome_ = before54; break
                    value, at = found; token = tokens[at]
                    guard_ = value
                    if not (token == ']'): at = before47; token = tokens[at]; who_ = before48; state_ = before49; guard_ = before50; act_ = before51; event_ = before52; function_ = before53; outcome_ = before54; break
                    at += 1; token = tokens[at]
                elif token in SET31:
                    taken59 = token; at += 1; token = tokens[at]
                    act_ = taken59
                    first = ends[at + 1] - len(token)
                    if not (token >= 'A' and token not in SET2): at = before47; token = tokens[at]; who_ = before48; state_ = before49; guard_ = before50; act_ = before51; event_ = before52; function_ = before53; outcome_ = before54; break
                    taken61 = token; at += 1; token = tokens[at]
                    text60 = taken61
                    if token == '.':
                        match62 = REGEX0(text, ends[at + 1] - len(token))
                        if match62[0]:
                            text60 += match62[0]
                            end = match62.end()
                            while ends[at] < end: at += 1
                            if ends[at] > end: at = before47; token = tokens[at]; who_ = before48; state_ = before49; guard_ = before50; act_ = before51; event_ = before52; function_ = before53; outcome_ = before54; break
                            token = tokens[at]
                    value = new_node(Ref)
                    value.name = text60
                    value.kind = 'Event'
                    value.span = new_span(Span, (source, first, first + len(text60)))
                    value.target = None
                    event_ = value
                    if token == '[':
                        before63 = at
                        before64 = guard_
                        while True:
                            at += 1; token = tokens[at]
                            found = expression(at)
                            if found is None: at = before63; token = tokens[at]; guard_ = before64; break
                            value, at = found; token = tokens[at]
                            guard_ = value
                            if not (token == ']'): at = before63; token = tokens[at]; guard_ = before64; break
                            at += 1; token = tokens[at]
                            break
                elif token in SET32:
                    taken65 = token; at += 1; token = tokens[at]
                    act_ = taken65
                    first = ends[at + 1] - len(token)
                    if not (token >= 'A' and token not in SET2): at = before47; token = tokens[at]; who_ = before48; state_ = before49; guard_ = before50; act_ = before51; event_ = before52; function_ = before53; outcome_ = before54; break
                    taken67 = token; at += 1; token = tokens[at]
                    text66 = taken67
                    if token == '.':
                        match68 = REGEX0(text, ends[at + 1] - len(token))
                        if match68[0]:
                            text66 += match68[0]
                            end = match68.end()
                            while ends[at] < end: at += 1
                            if ends[at] > end: at = before47; token = tokens[at]; who_ = before48; state_ = before49; guard_ = before50; act_ = before51; event_ = before52; function_ = before53; outcome_ = before54; break
                            token = tokens[at]
                    value = new_node(Ref)
                    value.name = text66
                    value.kind = 'Function'
                    value.span = new_span(Span, (source, first, first + len(text66)))
                    value.target = None
                    function_ = value
                elif token == 'ends':
                    at += 1; token = tokens[at]
                    act_ = 'ends'
                    first = ends[at + 1] - len(token)
                    if not (token >= 'A' and token not in SET2): at = before47; token = tokens[at]; who_ = before48; state_ = before49; guard_ = before50; act_ = before51; event_ = before52; function_ = before53; outcome_ = before54; break
                    taken70 = token; at += 1; token = tokens[at]
                    text69 = taken70
                    if token == '.':
                        match71 = REGEX0(text, ends[at + 1] - len(token))
                        if match71[0]:
                            text69 += match71[0]
                            end = match71.end()
                            while ends[at] < end: at += 1
                            if ends[at] > end: at = before47; token = tokens[at]; who_ = before48; state_ = before49; guard_ = before50; act_ = before51; event_ = before52; function_ = before53; outcome_ = before54; break
                            token = tokens[at]
                    value = new_node(Ref)
                    value.name = text69
                    value.kind = 'Function'
                    value.span = new_span(Span, (source, first, first + len(text69)))
                    value.target = None
                    function_ = value
                    if token == 'as':
                        before72 = at
                        before73 = outcome_
                        while True:
                            at += 1; token = tokens[at]
                            if not (token in SET33): at = before72; token = tokens[at]; outcome_ = before73; break
                            taken74 = token; at += 1; token = tokens[at]
                            outcome_ = taken74
                            break
                else: at = before47; token = tokens[at]; who_ = before48; state_ = before49; guard_ = before50; act_ = before51; event_ = before52; function_ = before53; outcome_ = before54; break
                chosen1 = True
                break
        if not chosen1 and token >= 'A' and token not in SET2:
            before75 = at
            before76 = event_
            before77 = guard_
            while True:
                first = ends[at + 1] - len(token)
                taken79 = token; at += 1; token = tokens[at]
                text78 = taken79
                if token == '.':
                    match80 = REGEX0(text, ends[at + 1] - len(token))
                    if match80[0]:
                        text78 += match80[0]
                        end = match80.end()
                        while ends[at] < end: at += 1
                        if ends[at] > end: at = before75; token = tokens[at]; event_ = before76; guard_ = before77; break
                        token = tokens[at]
                value = new_node(Ref)
                value.name = text78
                value.kind = 'Event'
                value.span = new_span(Span, (source, first, first + len(text78)))
                value.target = None
                event_ = value
                if token == '[':
                    before81 = at
                    before82 = guard_
                    while True:
                        at += 1; token = tokens[at]
                        found = expression(at)
                        if found is None: at = before81; token = tokens[at]; guard_ = before82; break
                        value, at = found; token = tokens[at]
                        guard_ = value
                        if not (token == ']'): at = before81; token = tokens[at]; guard_ = before82; break
                        at += 1; token = tokens[at]
                        break
                chosen1 = True
                break
        if not chosen1: return None
        made = new_node(Fact)
        made.span = new_span(Span, (source, start, ends[at]))
        made.counted = counted_
        made.state = state_
        made.comparison = comparison_
        made.number = number_
        made.who = who_
        made.guard = guard_
        made.act = act_
        made.event = event_
        made.function = function_
        made.outcome = outcome_
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

    def r_Who():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        quantifier_ = None
        other_ = False
        role_ = None
        lower_ = None
        upper_ = None
        index_ = None
        chosen1 = False
        if not chosen1 and token in SET35:
            before2 = at
            before3 = quantifier_
            before4 = other_
            before5 = role_
            while True:
                taken6 = token; at += 1; token = tokens[at]
                quantifier_ = taken6
                if token == 'other':
                    at += 1; token = tokens[at]
                    other_ = True
                if not (token >= 'A' and token not in SET2): at = before2; token = tokens[at]; quantifier_ = before3; other_ = before4; role_ = before5; break
                taken7 = token; at += 1; token = tokens[at]
                value = new_node(Ref)
                value.name = taken7
                value.kind = 'Role'
                value.span = new_span(Span, (source, ends[at] - len(taken7), ends[at]))
                value.target = None
                role_ = value
                chosen1 = True
                break
        if not chosen1 and (token == '*' or token < 'A' and token not in SET3):
            before8 = at
            before9 = lower_
            before10 = upper_
            before11 = role_
            while True:
                match12 = REGEX13(text, ends[at + 1] - len(token))
                if match12 is None: at = before8; token = tokens[at]; lower_ = before9; upper_ = before10; role_ = before11; break
                end = match12.end()
                while ends[at] < end: at += 1
                if ends[at] > end: at = before8; token = tokens[at]; lower_ = before9; upper_ = before10; role_ = before11; break
                token = tokens[at]
                lower_ = match12[0]
                if token == '.':
                    before13 = at
                    before14 = upper_
                    while True:
                        if not (token == '.' and tokens[at + 1] == '.' and ends[at + 2] == ends[at + 1] + 1): at = before13; token = tokens[at]; upper_ = before14; break
                        at += 2; token = tokens[at]
                        match15 = REGEX13(text, ends[at + 1] - len(token))
                        if match15 is None: at = before13; token = tokens[at]; upper_ = before14; break
                        end = match15.end()
                        while ends[at] < end: at += 1
                        if ends[at] > end: at = before13; token = tokens[at]; upper_ = before14; break
                        token = tokens[at]
                        upper_ = match15[0]
                        break
                if not (token >= 'A' and token not in SET2): at = before8; token = tokens[at]; lower_ = before9; upper_ = before10; role_ = before11; break
                taken16 = token; at += 1; token = tokens[at]
                value = new_node(Ref)
                value.name = taken16
                value.kind = 'Role'
                value.span = new_span(Span, (source, ends[at] - len(taken16), ends[at]))
                value.target = None
                role_ = value
                chosen1 = True
                break
        if not chosen1 and token >= 'A' and token not in SET2:
            before17 = at
            before18 = role_
            before19 = index_
            while True:
                taken20 = token; at += 1; token = tokens[at]
                value = new_node(Ref)
                value.name = taken20
                value.kind = 'Role'
                value.span = new_span(Span, (source, ends[at] - len(taken20), ends[at]))
                value.target = None
                role_ = value
                if token == '[':
                    before21 = at
                    before22 = index_
                    while True:
                        at += 1; token = tokens[at]
                        match23 = REGEX9(text, ends[at + 1] - len(token))
                        if match23 is None: at = before21; token = tokens[at]; index_ = before22; break
                        end = match23.end()
                        while ends[at] < end: at += 1
                        if ends[at] > end: at = before21; token = tokens[at]; index_ = before22; break
                        token = tokens[at]
                        index_ = match23[0]
                        if not (token == ']'): at = before21; token = tokens[at]; index_ = before22; break
                        at += 1; token = tokens[at]
                        break
                chosen1 = True
                break
        if not chosen1: return None
        made = new_node(Who)
        made.span = new_span(Span, (source, start, ends[at]))
        made.quantifier = quantifier_
        made.other = other_
        made.lower = lower_
        made.upper = upper_
        made.role = role_
        made.index = index_
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

    def r_Defer():
        nonlocal at, token
        start = ends[at + 1] - 5
        if find('\n', ends[at], start) < 0: inline[at] = ';'
        events_ = []
        at += 1; token = tokens[at]
        value = r_DeferredEvent()
        if value is None: return None
        events_.append(value)
        while token == ',':
            before1 = at
            at += 1; token = tokens[at]
            value = r_DeferredEvent()
            if value is None: at = before1; token = tokens[at]; break
            events_.append(value)
        made = new_node(Defer)
        made.span = new_span(Span, (source, start, ends[at]))
        made.events = events_
        made.doc = docs.pop(start) if start in docs else ''
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
        if not chosen1 and token in SET36:
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
                if not (token in SET33): at = before21; token = tokens[at]; del triggers_[before22:]; break
                value = r_OutcomeTrigger()
                if value is None: at = before21; token = tokens[at]; del triggers_[before22:]; break
                triggers_.append(value)
                while token == ',':
                    before23 = at
                    at += 1; token = tokens[at]
                    if not (token in SET33): at = before23; token = tokens[at]; break
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
        while token in SET37:
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

    def r_DeferredEvent():
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
        made = new_node(DeferredEvent)
        made.span = new_span(Span, (source, start, ends[at]))
        made.event = event_
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
        delay_ = None
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
        if token == 'after':
            before10 = at
            before11 = delay_
            while True:
                match12 = REGEX16(text, ends[at + 1] - len(token))
                if match12 is None: at = before10; token = tokens[at]; delay_ = before11; break
                end = match12.end()
                while ends[at] < end: at += 1
                if ends[at] > end: at = before10; token = tokens[at]; delay_ = before11; break
                token = tokens[at]
                found = delay(at)
                if found is None: at = before10; token = tokens[at]; delay_ = before11; break
                value, at = found; token = tokens[at]
                delay_ = value
                break
        made = new_node(Send)
        made.span = new_span(Span, (source, start, ends[at]))
        made.event = event_
        made.arguments = arguments_
        made.to = to_
        made.delay = delay_
        return made

    def r_Cancel():
        nonlocal at, token
        start = ends[at + 1] - 6
        event_ = None
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
        made = new_node(Cancel)
        made.span = new_span(Span, (source, start, ends[at]))
        made.event = event_
        return made

    def r_Append():
        nonlocal at, token
        start = ends[at + 1] - 6
        value_ = None
        target_ = None
        at += 1; token = tokens[at]
        found = expression(at)
        if found is None: return None
        value, at = found; token = tokens[at]
        value_ = value
        if not (token == 'to'): return None
        at += 1; token = tokens[at]
        found = operand(at)
        if found is None: return None
        value, at = found; token = tokens[at]
        target_ = value
        made = new_node(Append)
        made.span = new_span(Span, (source, start, ends[at]))
        made.value = value_
        made.target = target_
        return made

    def r_Remove():
        nonlocal at, token
        start = ends[at + 1] - 6
        target_ = None
        at += 1; token = tokens[at]
        found = operand(at)
        if found is None: return None
        value, at = found; token = tokens[at]
        target_ = value
        made = new_node(Remove)
        made.span = new_span(Span, (source, start, ends[at]))
        made.target = target_
        return made

    def r_Clear():
        nonlocal at, token
        start = ends[at + 1] - 5
        target_ = None
        at += 1; token = tokens[at]
        found = operand(at)
        if found is None: return None
        value, at = found; token = tokens[at]
        target_ = value
        made = new_node(Clear)
        made.span = new_span(Span, (source, start, ends[at]))
        made.target = target_
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

    def r_Address():
        nonlocal at, token
        start = ends[at + 1] - len(token)
        id_ = None
        found = expression(at)
        if found is None: return None
        value, at = found; token = tokens[at]
        id_ = value
        made = new_node(Address)
        made.span = new_span(Span, (source, start, ends[at]))
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

    def try_SubjectTo_ParamRange():
        nonlocal at, token
        before = at
        made = r_SubjectTo()
        if made is not None: return made
        at = before; token = tokens[at]
        return r_ParamRange()

    def try_Equipment_Part():
        nonlocal at, token
        before = at
        made = r_Equipment()
        if made is not None: return made
        at = before; token = tokens[at]
        return r_Part()

    def try_Contract_Part():
        nonlocal at, token
        before = at
        made = r_Contract()
        if made is not None: return made
        at = before; token = tokens[at]
        return r_Part()

    def try_Heartbeat_Role_RobotValues():
        nonlocal at, token
        before = at
        made = r_Heartbeat()
        if made is not None: return made
        at = before; token = tokens[at]
        made = r_Role()
        if made is not None: return made
        at = before; token = tokens[at]
        return r_RobotValues()

    def try_Role_RobotValues():
        nonlocal at, token
        before = at
        made = r_Role()
        if made is not None: return made
        at = before; token = tokens[at]
        return r_RobotValues()

    def try_Append_Assignment():
        nonlocal at, token
        before = at
        made = r_Append()
        if made is not None: return made
        at = before; token = tokens[at]
        return r_Assignment()

    def try_Cancel_Assignment():
        nonlocal at, token
        before = at
        made = r_Cancel()
        if made is not None: return made
        at = before; token = tokens[at]
        return r_Assignment()

    def try_Clear_Assignment():
        nonlocal at, token
        before = at
        made = r_Clear()
        if made is not None: return made
        at = before; token = tokens[at]
        return r_Assignment()

    def try_Remove_Assignment():
        nonlocal at, token
        before = at
        made = r_Remove()
        if made is not None: return made
        at = before; token = tokens[at]
        return r_Assignment()

    def try_DoneTrigger_EventTrigger():
        nonlocal at, token
        before = at
        made = r_DoneTrigger()
        if made is not None: return made
        at = before; token = tokens[at]
        return r_EventTrigger()

    Import_RULES = {'import': try_ImportRos_ImportFile_ImportLibrary}
    Declaration_RULES = {'action': r_ActionType, 'actuator': r_Component, 'const': r_Constant, 'controller': r_Component, 'endless': r_StateMachine, 'enum': r_EnumType, 'environment': r_Environment, 'event': r_Event, 'fitness': r_Fitness, 'function': r_Function, 'member': r_Member, 'message': r_MessageType, 'operator': r_Event, 'property': r_Property, 'sensor': r_Component, 'service': r_ServiceType, 'statemachine': r_StateMachine, 'struct': r_StructType, 'swarm': try_Event_Swarm, 'type': r_AliasType, 'virtual': r_Component}
    OptimizationItem_RULES = {'count': try_CountRange_ParamRange, 'evaluations': try_Setting_ParamRange, 'seed': try_Setting_ParamRange, 'steps': try_Setting_ParamRange, 'subject': try_SubjectTo_ParamRange}
    FunctionItem_RULES = {'action': r_Communication, 'in': r_FunctionPort, 'model': r_ModelUse, 'out': r_FunctionPort, 'param': r_Param, 'service': r_Communication}
    ComponentItem_RULES = {'behavior': r_BehaviorUse, 'in': r_Port, 'inout': r_Port, 'operation': r_Operation, 'out': r_Port, 'param': r_Param, 'senses': r_Sight}
    MemberItem_RULES = {'battery': try_Equipment_Part, 'behavior': r_BehaviorUse, 'body': try_Equipment_Part, 'communication': r_CommunicationSettings, 'connect': r_Connector, 'contract': try_Contract_Part, 'in': r_Port, 'inout': r_Port, 'out': r_Port, 'param': r_Param, 'radio': try_Equipment_Part}
    MachineItem_RULES = {'choice': r_Choice, 'deep': r_History, 'final': r_FinalState, 'history': r_History, 'initial': r_Initial, 'parallel': r_Parallel, 'param': r_Param, 'state': r_State, 'var': r_Variable}
    SwarmItem_RULES = {'environment': r_EnvironmentUse, 'fitness': r_FitnessUse, 'heartbeat': try_Heartbeat_Role_RobotValues}
    EnvironmentItem_RULES = {'area': r_Area, 'obstacle': r_Obstacle, 'rain': r_Rain, 'size': r_Size, 'target': r_Targets, 'wall': r_Wall, 'wind': r_Wind, 'world': r_World, 'zone': r_Zone}
    FitnessItem_RULES = {'in': r_FitnessInput, 'maximize': r_Objective, 'minimize': r_Objective, 'param': r_Param}
    StateItem_RULES = {'[': r_Transition, 'after': r_Transition, 'choice': r_Choice, 'deep': r_History, 'defer': r_Defer, 'do': r_Activity, 'entry': r_Entry, 'exit': r_Exit, 'final': r_FinalState, 'history': r_History, 'initial': r_Initial, 'internal': r_Transition, 'monitor': r_Transition, 'on': r_Transition, 'parallel': r_Parallel, 'state': r_State, 'var': r_Variable}
    ParallelItem_RULES = {'[': r_Transition, 'after': r_Transition, 'defer': r_Defer, 'entry': r_Entry, 'exit': r_Exit, 'internal': r_Transition, 'monitor': r_Transition, 'on': r_Transition, 'region': r_Region, 'var': r_Variable}
    Effect_RULES = {'(': r_Assignment, '-': r_Assignment, 'append': try_Append_Assignment, 'cancel': try_Cancel_Assignment, 'clear': try_Clear_Assignment, 'event': r_Assignment, 'false': r_Assignment, 'in': r_Assignment, 'neighbors': r_Assignment, 'not': r_Assignment, 'remove': try_Remove_Assignment, 'self': r_Assignment, 'send': r_Send, 'true': r_Assignment}
    Trigger_RULES = {'aborted': r_OutcomeTrigger, 'done': r_DoneTrigger, 'preempted': r_OutcomeTrigger, 'succeeded': r_OutcomeTrigger}
    RegionItem_RULES = {'choice': r_Choice, 'deep': r_History, 'final': r_FinalState, 'history': r_History, 'initial': r_Initial, 'parallel': r_Parallel, 'state': r_State, 'var': r_Variable}

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
        r_Model = r_Package = r_Optimization = r_ImportRos = r_ImportFile = r_ImportLibrary = r_StructType = r_EnumType = r_AliasType = r_Constant = r_MessageType = r_ServiceType = r_ActionType = r_Event = r_Function = r_Component = r_Member = r_StateMachine = r_Swarm = r_Environment = r_Fitness = r_Property = r_Field = r_TypeRef = r_EnumValue = r_DeliverySetting = r_Each = r_PropertyScope = r_Pattern = r_Chance = r_Setting = r_SubjectTo = r_CountRange = r_ParamRange = r_Communication = r_FunctionPort = r_Param = r_ModelUse = r_Port = r_Operation = r_BehaviorUse = r_Sight = r_CommunicationSettings = r_Equipment = r_Connector = r_Contract = r_Part = r_Variable = r_Initial = r_EnvironmentUse = r_FitnessUse = r_Heartbeat = r_Role = r_RobotValues = r_World = r_Size = r_Area = r_Zone = r_Wall = r_Obstacle = r_Targets = r_Wind = r_Rain = r_FitnessInput = r_Objective = r_Claim = r_Term = r_Argument = r_Parameter = r_PartValue = r_PortRef = r_EventTrigger = r_SafeState = r_State = r_Parallel = r_Choice = r_History = r_FinalState = r_Multiplicity = r_Start = r_Box = r_Height = r_Point = r_SpaceMeasure = r_Measure = r_Conjunction = r_Fact = r_Branch = r_Who = r_Activity = r_Defer = r_Entry = r_Exit = r_Transition = r_Region = r_ResultMapping = r_DeferredEvent = r_TimeTrigger = r_MonitorTrigger = r_OutcomeTrigger = r_Send = r_Cancel = r_Append = r_Remove = r_Clear = r_Assignment = r_DoneTrigger = r_Address = try_ImportRos_ImportFile_ImportLibrary = try_Event_Swarm = try_CountRange_ParamRange = try_Setting_ParamRange = try_SubjectTo_ParamRange = try_Equipment_Part = try_Contract_Part = try_Heartbeat_Role_RobotValues = try_Role_RobotValues = try_Append_Assignment = try_Cancel_Assignment = try_Clear_Assignment = try_Remove_Assignment = try_DoneTrigger_EventTrigger = Import_RULES = Declaration_RULES = OptimizationItem_RULES = FunctionItem_RULES = ComponentItem_RULES = MemberItem_RULES = MachineItem_RULES = SwarmItem_RULES = EnvironmentItem_RULES = FitnessItem_RULES = StateItem_RULES = ParallelItem_RULES = Effect_RULES = Trigger_RULES = RegionItem_RULES = None

LANGUAGE = Language(LEXER, RESERVED)
# An item may stand after them on one line; the last one is the start of the file.
SEPARATORS = frozenset(("", *"{};,"))
