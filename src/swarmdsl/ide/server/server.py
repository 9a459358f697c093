"""Server loop: registers features, schedules diagnostics, detects the end.

Source: LSP 3.17, implemented by pygls. Each feature is a function from a session and the params of
a request to its result, in one of the `handlers`.
"""

from __future__ import annotations

import gc
import os
import sys
import time
import traceback
from functools import partial
from queue import Empty
from typing import BinaryIO

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException, JsonRpcInternalError
from pygls.lsp.server import LanguageServer

from swarmdsl import __version__
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.ide.server import lifecycle
from swarmdsl.ide.server.features import FEATURES, answer, handlers_of
from swarmdsl.ide.server.io import Incoming, Outgoing
from swarmdsl.ide.server.message_queue import SerialProtocol
from swarmdsl.ide.server.session import Session
from swarmdsl.syntax.parse import parse

# Interval between checks that the parent process is alive, in seconds.
_CLIENT_CHECK = 5.0
# Garbage is collected after this many seconds without a message, after this many messages, or when
# there are this many objects more than after the last collection (about 30 MB): an edit that
# affects many declarations leaves a tenth of that. After each edit, it would take too long.
_IDLE_AFTER = 0.5
_MESSAGES_PER_COLLECTION = 200
_OBJECTS_PER_COLLECTION = 250_000
# If checking takes less than this (seconds), diagnostics follow at once. Otherwise the server waits
# as long as a check takes, at most the second value, so that further edits cost nothing.
_FAST_CHECK = 0.05
_MAX_DELAY = 0.5


def serve(reader: BinaryIO, writer: BinaryIO) -> int:
    """Serve one client until it disconnects; return the exit code of the protocol."""
    server = Server(Outgoing(writer))
    gc.disable()  # the server collects when it is idle
    gc.freeze()  # modules loaded so far are never garbage
    return server.serve(Incoming(reader))


class Server(LanguageServer):
    """Serves one client; publishes diagnostics when no message waits."""

    protocol: SerialProtocol

    def __init__(self, outgoing: Outgoing) -> None:
        super().__init__("swarmc", __version__, protocol_cls=SerialProtocol)
        self.session = Session(self)
        self._outgoing = outgoing
        self._duration = 0.0
        self._messages = 0
        self._prepared = False
        self.protocol.set_writer(outgoing)
        for name, handler in lifecycle.NOTIFICATIONS.items():
            self.feature(name)(partial(handler, self.session))
        for module, features in FEATURES.items():
            for name, options in features.items():
                self.feature(name, options)(partial(answer, module, name, self.session))

    def serve(self, incoming: Incoming) -> int:
        """Process messages until the client exits; return the exit code."""
        self.protocol.listen(incoming)
        try:
            while self._step():
                pass
        except SystemExit:
            pass  # `exit` notification
        return self.protocol.exit_code

    def _step(self) -> bool:
        """Process one message or idle task; return False at the end of the session."""
        try:
            message = self.protocol.receive(self._timeout())
        except Empty:
            if self.session.dirty:
                self._publish()
                if self._has_garbage():
                    self._collect()
                return True
            if self._messages:
                self._idle()
                return True
            return self._client_is_alive()
        if message is None:
            return False
        self._messages += 1
        self.protocol.process(message)
        if self.session.dirty and not self.session.models.has_pending_edits:
            self._publish()  # the models are up to date after the answer
        if self._has_garbage():
            self._collect()
        return not self._outgoing.gone

    def _timeout(self) -> float:
        """Return how long to wait for a message before an idle task, in seconds."""
        if not self.session.dirty:
            return _IDLE_AFTER if self._messages else _CLIENT_CHECK
        return 0.0 if self._duration < _FAST_CHECK else min(self._duration, _MAX_DELAY)

    def _publish(self) -> None:
        start = time.perf_counter()
        try:
            self.session.publish_diagnostics()
        except Exception as error:
            self.report_server_error(error)
        self._duration = time.perf_counter() - start

    def _idle(self) -> None:
        """Import lazily loaded modules and collect garbage."""
        try:
            if not self._prepared:
                self._prepared = True
                from swarmdsl.ide.server import support

                support.load_generators()
                for module in FEATURES:
                    handlers_of(module)
                # The error reporting of the parser is imported at its first error.
                parse(Source("", "event"), Diagnostics())
        except Exception as error:
            self.report_server_error(error)
        self._collect()

    def _has_garbage(self) -> bool:
        """Return True if so much may be garbage that a collection does not wait any longer."""
        many = _new_objects() >= _OBJECTS_PER_COLLECTION
        return many or self._messages >= _MESSAGES_PER_COLLECTION

    def _collect(self) -> None:
        self._messages = 0
        gc.collect()

    def _client_is_alive(self) -> bool:
        """Return True if the parent process is alive or unknown."""
        if self.process_id is None or self.process_id <= 0 or sys.platform == "win32":
            return True
        try:
            os.kill(self.process_id, 0)
        except ProcessLookupError:
            return False
        except OSError:
            pass  # it belongs to another user
        return True

    def report_server_error(self, error: Exception, source: object = None) -> None:
        """Report an internal error to the log and to the client.

        A rejected request is not an internal error.
        """
        if not isinstance(error, JsonRpcException) or isinstance(error, JsonRpcInternalError):
            traceback.print_exc(file=sys.stderr)
            self.log(f"internal error: {error}")

    def log(self, message: str) -> None:
        """Send an error message to the log of the client."""
        self.window_log_message(lsp.LogMessageParams(type=lsp.MessageType.Error, message=message))


def _new_objects() -> int:
    """Return how many objects that may be garbage there are since the last collection.

    They are counted though automatic collection is off.
    """
    return gc.get_count()[0]
