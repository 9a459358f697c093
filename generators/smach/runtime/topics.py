"""Events of a machine on topics of the robot and of the swarm."""

import collections

import rospy

from . import engine
from .identity import identity

# Number of sent messages that may wait for a slow connection; rospy drops the oldest of more.
_QUEUE = 10000


class Event:
    """An event, received and sent as a message on a topic.

    The `envelope` is the type of a message around it with its sender, its time and its address, if
    a machine asks for them. With `latch`, who comes later gets the last message; `queue_size` is
    the number of messages that may wait for a slow connection.
    """

    machine = None
    """The instance whose effects run: delayed sends are its timers."""

    def __init__(
        self,
        name,
        message_type,
        heard_on,
        sent_on,
        envelope=None,
        latch=False,
        queue_size=_QUEUE,
    ):
        self.name = name
        self.latch = latch
        self.queue_size = queue_size
        self.message_type = message_type
        self.heard_on = heard_on
        self.sent_on = sent_on
        self.envelope = envelope
        self._publisher = None
        self._sender = ''
        self._times = collections.deque(maxlen=_QUEUE)

    def listen(self, receive):
        """Call `receive(name, message, envelope)` with each message from now on."""
        if self.envelope is None:

            def hear(received):
                if not (self._is_of_swarm and _is_from_here(received)):
                    receive(self.name, received)

            rospy.Subscriber(self.heard_on, self.message_type, hear)
            return
        robot = identity()
        self._sender = robot.id
        # An event is for others: the robot itself, and those with another address, ignore it.
        addresses = [name for name in (robot.id, robot.role) if name]

        def open_envelope(received):
            if received.to and received.to not in addresses:
                return
            if not self._is_own(received):
                to = received.to or None
                about = engine.Envelope(received.sender, received.sent.to_nsec(), to)
                receive(self.name, received.message, about)

        rospy.Subscriber(self.heard_on, self.envelope, open_envelope)

    def advertise(self):
        """Create the publisher, once."""
        if self._publisher is None:
            self._sender = identity().id
            kind = self.envelope or self.message_type
            self._publisher = rospy.Publisher(
                self.sent_on, kind, latch=self.latch, queue_size=self.queue_size
            )

    def send(self, message, to=None):
        """Publish a message, with its time and sender in empty headers.

        It is for a robot or a role, or for all others. An empty address is that of nobody.
        """
        if to == '':
            rospy.logwarn('%s is sent to nobody: its address is empty', self.name)
            return
        self._sign(message)
        if self.envelope is not None:
            message = self.envelope(message=message, to=to or '')
            message.sender, message.sent = self._sender, rospy.Time.now()
            self._sign(message)
            self._times.append(message.sent.to_nsec())
        try:
            self._publisher.publish(message)
        except rospy.ROSException:
            if not rospy.is_shutdown():  # messages are lost during a shutdown
                raise

    def send_after(self, delay, message, to=None):
        """Publish a message after a delay, unless it is cancelled or the machine ends before."""
        about = engine.Envelope(to=to)
        sending = engine.Event(self.name, lambda: self.send(message, to), envelope=about)
        Event.machine.emit_after(sending, delay.to_nsec())

    def cancel(self):
        """Cancel the delayed messages that are pending."""
        Event.machine.cancel('send.{}'.format(self.name))

    @property
    def _is_of_swarm(self):
        """True for an event that is for others; an event of the robot itself may be heard here."""
        return self.heard_on != self.sent_on

    def _is_own(self, received):
        """Return True for an envelope of this robot; without an id, for one that was sent here."""
        if received.sender or self._sender:
            return received.sender == self._sender
        return _is_from_here(received) or received.sent.to_nsec() in self._times

    def _sign(self, message):
        """Fill in the time in empty headers of a message, and its sender.

        The sender of a swarm event is this robot, also if it has the message from another one.
        """
        for field, kind in zip(message.__slots__, message._slot_types):
            header = getattr(message, field)
            if kind == 'std_msgs/Header':
                header.stamp = header.stamp or rospy.Time.now()
            elif kind == 'swarmros/EventHeader':
                header.name = header.name or self.sent_on
                if self._is_of_swarm or not header.node:
                    header.node = self._sender or header.node


def _is_from_here(message):
    """Return True for a message that this node has published."""
    connection = getattr(message, '_connection_header', None) or {}
    return connection.get('callerid') == rospy.get_name()
