"""Runs a state machine as a ROS node."""

import queue
import signal
import sys
import threading
import time
import traceback

import rospy
import smach_ros

from .states import StartError

# How long a machine has to end when ROS shuts down, in seconds.
GRACE = 1.5
# How long its last messages have to leave: rospy drops what is still in its queues.
LAST_WORDS = 0.1
# How long the node has to take its leave of others, in seconds.
LEAVE = 10


def run(name, behavior, params=()):
    """Run the machine that a module builds, to its end or until ROS shuts down; then exit.

    `params` are those of the machine that must have a value. With `~introspection`, smach_viewer
    shows the machine. The exit code is 1 where the machine could not begin or go on.
    """
    ending = _Ending()
    failed = False
    try:
        rospy.init_node(name, disable_signals=True)
        missing = [rospy.resolve_name(param) for param in params if not rospy.has_param(param)]
        if missing:
            rospy.logfatal('params without a value: %s', ', '.join(missing))
            sys.exit(1)
        runner = _Runner(behavior.build())
        if rospy.get_param('~introspection', False):
            smach_ros.IntrospectionServer('smach_server', runner.machine, '/' + name).start()
        rospy.on_shutdown(runner.stop)
        if not rospy.is_shutdown():
            runner.start()
            rospy.spin()
            failed = runner.failed
    except StartError as error:
        rospy.logfatal('%s', error)
        sys.exit(1)
    except Exception:
        # What ends before it has begun cannot begin.
        if not rospy.is_shutdown():
            raise
    finally:
        ending.wait()
    sys.exit(1 if failed else 0)


class _Ending(threading.Thread):
    """Ends the node when a signal comes.

    What a signal interrupts in the main thread may hold a lock of rospy, and a handler that shuts
    down there would wait for it for ever.
    """

    def __init__(self):
        super().__init__(name='ending', daemon=True)
        self._signals = queue.SimpleQueue()
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, lambda number, frame: self._signals.put(number))
        self.start()

    def run(self):
        """Wait for the first signal."""
        number = self._signals.get()
        if number is not None:
            rospy.signal_shutdown('signal {}'.format(number))

    def wait(self):
        """Return when others have been told that the node ends."""
        self._signals.put(None)
        self.join(LEAVE)


class _Runner(threading.Thread):
    """The machine in a thread of its own: in the main one it would not let signals through."""

    def __init__(self, machine):
        super().__init__(name='state machine', daemon=True)
        self.machine = machine
        self.failed = False
        self._ended = threading.Event()

    def run(self):
        """Run the machine; without it the node has nothing left to do."""
        outcome = None
        try:
            outcome = self.machine.execute()
        except Exception:
            self.failed = True
            rospy.logfatal('the state machine failed:\n%s', traceback.format_exc())
        self._ended.set()
        rospy.signal_shutdown('state machine ended: {}'.format(outcome))

    def stop(self):
        """Preempt the machine and let it cancel what runs, while ROS still lets it."""
        self.machine.request_preempt()
        self._ended.wait(GRACE)
        time.sleep(LAST_WORDS)
