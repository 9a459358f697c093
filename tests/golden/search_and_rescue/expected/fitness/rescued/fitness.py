#!/usr/bin/env python3
"""Computes the fitness Rescued of a run: fitness.py BAG [TIMEOUT ...]

Prints `fitness=<number>`, of which the greatest is the best.
An input is the `data` of the last message on the topic of its name, as std_msgs have it;
what the simulation manager says after BAG is not needed.

On ROS 2 the monitor of the swarm tells the inputs that the model measures. BAG is its trace,
`monitor.jsonl`, or a bag with its topic `measures`, a folder, which needs the Python package
`rosbags`. What the values depend on is written to standard error.
"""
# People that a rover reached, for the time that UAVs flew.

import json
import math
import os
import sys

# Which of the inputs are times, in seconds here.
INPUTS = {'found': False, 'driven': False, 'searched': True, 'answered': True, 'waiting': False}
PARAMS = {'price': 0.1}
# The inputs that the fitness depends on.
USED = ['driven', 'searched']


def fitness(values):
    """The fitness, from the values of inputs and params by name."""
    return values['driven'] - values['price'] * (values['searched'] / 60.0)


def measured(path):
    """The inputs by name, as far as they are in a bag."""
    import rosbag

    found = {}
    with rosbag.Bag(path) as bag:
        topics = [f'{root}{name}' for name in INPUTS for root in ('', '/')]
        for topic, message, _ in bag.read_messages(topics=topics):
            name = topic.lstrip('/')
            found[name] = message.data.to_sec() if INPUTS[name] else message.data
    return found


def told_in_trace(path):
    """The inputs by name, as the monitor has told them at last in its trace."""
    with open(path, encoding='utf-8') as lines:
        return told((path, line) for line in lines)


def told_in_bag(path):
    """The inputs by name in a bag of ROS 2, also those that other nodes measure."""
    try:
        from pathlib import Path

        from rosbags.highlevel import AnyReader, AnyReaderError
        from rosbags.typesys import Stores, get_typestore
    except ImportError:
        sys.exit('a bag of ROS 2 needs the Python package rosbags: pip install rosbags')
    types = get_typestore(Stores.ROS2_JAZZY)
    found, lines = {}, []
    try:
        with AnyReader([Path(path)], default_typestore=types) as bag:
            wanted = [each for each in bag.connections if is_wanted(each)]
            for connection, _, data in bag.messages(wanted) if wanted else ():
                message = bag.deserialize(data, connection.msgtype)
                name = connection.topic.lstrip('/')
                if name in INPUTS:
                    found[name] = seconds(message) if INPUTS[name] else message.data
                else:
                    lines.append((connection.topic, message.data))
    except (AnyReaderError, OSError) as error:
        sys.exit(f'{path} cannot be read: {error}')
    return {**found, **told(lines)}


def is_wanted(connection):
    """Return True for the topic of an input, and for one of measures."""
    of_monitor = connection.topic.endswith('/measures')
    is_line = of_monitor and connection.msgtype == 'std_msgs/msg/String'
    return is_line or connection.topic.lstrip('/') in INPUTS


def seconds(message):
    """A time of ROS 2 in seconds, which may be the `data` of a message."""
    time = getattr(message, 'data', message)
    return time.sec + time.nanosec / 1e9


def told(lines):
    """The inputs by name that a monitor has told at last, from its lines, each with its source."""
    last = {}
    for source, text in lines:
        try:
            line = json.loads(text)
        except ValueError:
            continue  # another program has told it
        if isinstance(line, dict) and line.get('fitness') == 'Rescued':
            last[source] = line
    if len(last) > 1:
        sys.exit(f'several monitors tell the inputs: {", ".join(sorted(last))}')
    found = {}
    for line in last.values():
        notes = list(line['conditions'])
        if not line['final']:
            notes.append('the monitor had not ended')
        for each in line['measures']:
            if each['name'] in USED and 'fault' in each:
                sys.exit(f'the fitness has no value: {each["name"]}: {each["fault"]}')
            if each['name'] in USED and not each.get('reached', True):
                notes.append(f'{each["name"]} is not reached, and its value a lower bound')
            found[each['name']] = each['value']
        for note in notes:
            print(f'note: {note}', file=sys.stderr)
    return found


def values_in(path):
    """The inputs by name, as far as they are known of a run."""
    if os.path.isdir(path):
        return told_in_bag(path)
    if not path.endswith('.jsonl'):
        return measured(path)
    try:
        return told_in_trace(path)
    except (OSError, UnicodeDecodeError) as error:
        sys.exit(f'{path} cannot be read: {error}')


def main():
    if len(sys.argv) < 2:
        sys.exit('usage: fitness.py BAG [TIMEOUT ...]')
    found = values_in(sys.argv[1])
    missing = [name for name in INPUTS if name not in found]
    if missing:
        sys.exit(f'no value in {sys.argv[1]} of: {", ".join(missing)}')
    try:
        value = float(fitness({**PARAMS, **found}))
    except (ArithmeticError, ValueError) as error:
        sys.exit(f'the fitness has no value: {error}')
    if not math.isfinite(value):
        sys.exit('the fitness has no value: it is not finite')
    print(f'fitness={value}')


if __name__ == '__main__':
    main()
