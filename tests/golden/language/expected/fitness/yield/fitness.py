#!/usr/bin/env python3
"""Computes the fitness Yield of a run: fitness.py BAG [TIMEOUT ...]

Prints `fitness=<number>`, of which the greatest is the best.
An input is the `data` of the last message on the topic of its name, as std_msgs have it;
what the simulation manager says after BAG is not needed.
"""

import math
import sys

# Which of the inputs are times, in seconds here.
INPUTS = {'rescued': False}
PARAMS = {'limit': 300.0}


def fitness(values):
    """The fitness, from the values of inputs and params by name."""
    return values['rescued'] * 2


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


def main():
    if len(sys.argv) < 2:
        sys.exit('usage: fitness.py BAG [TIMEOUT ...]')
    found = measured(sys.argv[1])
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
