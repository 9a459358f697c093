"""Run a state machine as a ROS node."""

import faulthandler
import queue
import signal
import sys
import threading
import time
import traceback

import rospy
import smach_ros

from .states import StartError

# Time in which a machine has to end when ROS shuts down, in seconds.
GRACE = 1.5
# Time for the last messages in seconds: rospy drops those that are still in its queues.
LAST_WORDS = 0.1
# Time in which the node has to unregister, in seconds.
LEAVE = 10
# Time in which the process has to end, in seconds.
LATE = 20


def run(name, behavior, params=()):
    """Run the machine that a module builds until it ends or ROS shuts down, then exit.

    `params` are the params of the machine that require a value. With `~introspection`, smach_viewer
    shows the machine. The exit code is 1 if the machine could not start or has failed.
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
        # A shutdown during the start raises exceptions.
        if not rospy.is_shutdown():
            raise
    finally:
        ending.wait()
    sys.exit(1 if failed else 0)


class _Ending(threading.Thread):
    """Ends the node when a signal comes.

    Code that a signal interrupts in the main thread may hold a lock of rospy. A handler that shuts
    down there would wait for the lock forever.
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
        # Prints where all threads are, and exits: the master may never answer.
        faulthandler.dump_traceback_later(LATE, exit=True)
        if number is not None:
            rospy.signal_shutdown('signal {}'.format(number))

    def wait(self):
        """Return when the node has unregistered."""
        self._signals.put(None)
        self.join(LEAVE)


class _Runner(threading.Thread):
    """Runs the machine in its own thread: in the main thread it would block signals."""

    def __init__(self, machine):
        super().__init__(name='state machine', daemon=True)
        self.machine = machine
        self.failed = False
        self._ended = threading.Event()

    def run(self):
        """Run the machine; when it ends, the node ends."""
        outcome = None
        try:
            outcome = self.machine.execute()
        except Exception:
            self.failed = True
            rospy.logfatal('the state machine failed:\n%s', traceback.format_exc())
        self._ended.set()
        rospy.signal_shutdown('state machine ended: {}'.format(outcome))

    def stop(self):
        """Preempt the machine, and wait until it has cancelled its activities."""
        self.machine.request_preempt()
        self._ended.wait(GRACE)
        time.sleep(LAST_WORDS)
