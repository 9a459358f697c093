"""The server: which features it has, when it tells what is wrong, and how it ends.

Source: LSP 3.17, as pygls has it. Each feature is a function from a session and the params of a
request to its result, in one of the `..._answers` modules.
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
from swarmdsl.ide.server.features import FEATURES, answer, requests
from swarmdsl.ide.server.io import Incoming, Outgoing
from swarmdsl.ide.server.message_queue import Conversation
from swarmdsl.ide.server.session import Session
from swarmdsl.syntax.parse import parse

# Between two looks at whether the process that started the server is still there, in seconds.
_LOOK = 5.0
# Garbage is looked for when nothing was asked for that many seconds, or after that many messages:
# in the middle of a key, it would take a tenth of its time.
_REST = 0.5
_MOST_MESSAGES = 200
# What is wrong is told again at once if that takes less, else after as long: keys that come
# meanwhile cost nothing.
_AT_ONCE = 0.05
_LONGEST_PAUSE = 0.5


def serve(reader: BinaryIO, writer: BinaryIO) -> int:
    """Answer one client until it is gone; return the exit code that the protocol asks for."""
    server = Server(Outgoing(writer))
    gc.disable()  # the server does that when nobody waits
    gc.freeze()  # what is there by now stays, and is not looked at
    return server.serve(Incoming(reader))


class Server(LanguageServer):
    """Answers one client, and tells it what is wrong once nothing else waits."""

    protocol: Conversation

    def __init__(self, outgoing: Outgoing) -> None:
        super().__init__("swarmc", __version__, protocol_cls=Conversation)
        self.session = Session(self)
        self._outgoing = outgoing
        self._duration = 0.0
        self._messages = 0
        self._prepared = False
        self.protocol.set_writer(outgoing)
        for name, hear in lifecycle.NOTIFICATIONS.items():
            self.feature(name)(partial(hear, self.session))
        for module, features in FEATURES.items():
            for name, options in features.items():
                self.feature(name, options)(partial(answer, module, name, self.session))

    def serve(self, incoming: Incoming) -> int:
        """Answer until the client says so, or is gone; return the exit code."""
        self.protocol.listen(incoming)
        try:
            while self._step():
                pass
        except SystemExit:
            pass  # as the client has asked
        return self.protocol.exit_code

    def _step(self) -> bool:
        """Do what is next; return whether there may be more."""
        try:
            message = self.protocol.receive(self._pause())
        except Empty:
            if self.session.dirty:
                self._tell()
                return True
            if self._messages:
                self._rest()
                return True
            return self._client_lives()
        if message is None:
            return False
        self._messages += 1
        self.protocol.take(message)
        if self.session.dirty and not self.session.models.waiting:
            self._tell()  # the work is done, for the answer that was just given
        if self._messages >= _MOST_MESSAGES:
            self._tidy()
        return not self._outgoing.gone

    def _pause(self) -> float:
        """How long to wait for a message before there is something else to do."""
        if not self.session.dirty:
            return _REST if self._messages else _LOOK
        return 0.0 if self._duration < _AT_ONCE else min(self._duration, _LONGEST_PAUSE)

    def _tell(self) -> None:
        start = time.perf_counter()
        try:
            self.session.tell()
        except Exception as error:
            self.report_server_error(error)
        self._duration = time.perf_counter() - start

    def _rest(self) -> None:
        """Do what nobody should wait for."""
        try:
            if not self._prepared:
                self._prepared = True
                from swarmdsl.ide.server import support

                support.prepare()
                for module in FEATURES:
                    requests(module)
                # What reads mistakes is imported with the first one.
                parse(Source("", "event"), Diagnostics())
        except Exception as error:
            self.report_server_error(error)
        self._tidy()

    def _tidy(self) -> None:
        self._messages = 0
        gc.collect()

    def _client_lives(self) -> bool:
        """Whether the process that started the server is there, as far as it was named."""
        if self.process_id is None or self.process_id <= 0 or sys.platform == "win32":
            return True
        try:
            os.kill(self.process_id, 0)
        except ProcessLookupError:
            return False
        except OSError:
            pass  # it belongs to somebody else
        return True

    def report_server_error(self, error: Exception, source: object = None) -> None:
        """Note a mistake of the server itself for its log, and tell the client of it.

        That a request is refused is no such mistake.
        """
        if not isinstance(error, JsonRpcException) or isinstance(error, JsonRpcInternalError):
            traceback.print_exc(file=sys.stderr)
            self.log(f"internal error: {error}")

    def log(self, message: str) -> None:
        """Tell of a mistake in what the client said, or in the server."""
        self.window_log_message(lsp.LogMessageParams(type=lsp.MessageType.Error, message=message))
