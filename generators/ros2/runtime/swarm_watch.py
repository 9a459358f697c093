"""Monitors of a swarm, and of the state machines that its robots run."""

from collections import Counter
from itertools import islice

from .property_monitors import FALSE, OPEN, Plan, PropertyResult, TRUE, Watch
from .robot_lines import Actor, machine_of, MILLISECOND, Robot


class Watches:
    """
    Judges the lines of all robots: a monitor of the swarm, and one for each of their machines.

    `told` is called with a property, its verdict so far, and the time from which on it holds. The
    verdict on a property of a machine is the worst of those of the robots that run it.
    """

    def __init__(self, swarm, told):
        self._machines = swarm.machines
        self._told = told
        measures = [each.measure for each in swarm.measures]
        self._swarm = Watch(Plan(swarm.properties, measures), _has, told=told)
        self._alone = {}
        self._worst = {}
        self._seen = Counter()

    def see(self, line):
        """Process a line, in the order of time."""
        self._swarm.see(line)
        machine = self._machines[machine_of(line.actor.name)]
        if machine.properties:
            name = line.actor.name
            if name not in self._alone:
                self._alone[name] = _Alone(line, machine.properties, self._tell)
            self._alone[name].see(line)

    def advance(self, time):
        """Let time pass without a line."""
        self._swarm.advance(time)
        for each in self._alone.values():
            each.advance(time)

    @property
    def due(self):
        """Time after which `advance` must be called, unless a line comes before."""
        dues = [self._swarm.due, *(each.due for each in self._alone.values())]
        return min((each for each in dues if each is not None), default=None)

    def new_violations(self):
        """Yield the violations since this was asked last."""
        for each in (self._swarm, *self._alone.values()):
            for violation in islice(each.violations, self._seen[each], None):
                yield violation if each is self._swarm else each.in_swarm(violation)
            self._seen[each] = len(each.violations)

    def results(self, time):
        """Return the verdicts at the end of a run, which robots may go on with."""
        found = self._swarm.results(time, ended=False)
        by_property = {each: [] for each in properties_of(self._machines)}
        for alone in self._alone.values():
            for result in alone.results(time):
                by_property[result.property].append((alone.name, result))
        return found + [_worst(*each) for each in by_property.items()]

    def readings(self, time):
        """Return the values of the measures so far, None before all machines have started."""
        return self._swarm.readings(time) if self._swarm.has_begun else None

    def last_readings(self, time):
        """Return the values of the measures at the end of the run."""
        return self._swarm.readings(time)

    def _tell(self, property_, time):
        """Tell the worst verdict so far of the robots that run a machine, if it is another one."""
        told = (each.states.get(property_) for each in self._alone.values())
        worst = _worst_of({*told})
        if self._worst.get(property_) != worst:
            self._worst[property_] = worst
            self._told(property_, worst, time)


class _Alone:
    """
    Monitor of the machine of one robot, as if it were alone.

    Its run begins with its node; outside, times are those of the swarm.
    """

    def __init__(self, line, properties, tell):
        self.name = line.actor.name
        self._actor = Actor(
            self.name, Robot(self.name, ''), line.actor.states, line.actor.functions
        )
        self._began = max(line.time - line.record['t'] * MILLISECOND, 0)
        self._tell = tell
        self.states = dict.fromkeys(properties, OPEN)
        self._watch = Watch(Plan(properties), _has, told=self._note)

    def see(self, line):
        self._watch.see(line._replace(time=line.time - self._began, actor=self._actor))

    def advance(self, time):
        self._watch.advance(time - self._began)

    @property
    def due(self):
        due = self._watch.due
        return due + self._began if due is not None else None

    @property
    def violations(self):
        return self._watch.violations

    def results(self, time):
        return self._watch.results(time - self._began, ended=False)

    def in_swarm(self, violation):
        """Return a violation with the robot, and with times of the swarm."""
        last = tuple(each._replace(time=each.time + self._began) for each in violation.last)
        time = violation.time + self._began
        return violation._replace(robot=self.name, time=time, last=last)

    def _note(self, property_, verdict, time):
        self.states[property_] = verdict
        self._tell(property_, time + self._began)


def properties_of(machines):
    """Return the properties of the machines of all roles and parts, each once."""
    return list(dict.fromkeys(each for one in machines.values() for each in one.properties))


def _worst(property_, found):
    """Return the worst of the verdicts of machines, each with its name."""
    verdict = _worst_of([result.verdict for _, result in found])
    worst = [(name, result) for name, result in found if result.verdict == verdict]
    remarks = [result.remark for _, result in worst] or ['there was no robot']
    return PropertyResult(
        property_,
        verdict,
        tuple(name for name, _ in worst),
        (),
        '' if '' in remarks else min(remarks),
    )


def _worst_of(verdicts):
    return next((each for each in (FALSE, OPEN) if each in verdicts), TRUE)


def _has(line, fact):
    return line.values.get(fact.condition) is True
