"""The protocol: which requests and notifications there are, and what a client is told it can ask.

Source: LSP 3.17. Each feature is a function from a session and the params of a request to its
result, in one of the `..._answers` modules.
"""

from __future__ import annotations

import os
import sys
import time
import traceback
from collections.abc import Callable, Mapping
from typing import Any

from swarmdsl import __version__
from swarmdsl.server import connection as rpc
from swarmdsl.server import (
    editing_answers,
    lifecycle,
    navigation_answers,
    preview_answers,
    reading_answers,
)
from swarmdsl.server.connection import Connection, Json, Reader, RequestError, Writer
from swarmdsl.server.session import Session

Answer = Callable[[Session, Json], Any]

REQUESTS: Mapping[str, Answer] = {
    **reading_answers.REQUESTS,
    **navigation_answers.REQUESTS,
    **editing_answers.REQUESTS,
    **preview_answers.REQUESTS,
}
_CAPABILITIES: Json = {
    **lifecycle.CAPABILITIES,
    **reading_answers.CAPABILITIES,
    **navigation_answers.CAPABILITIES,
    **editing_answers.CAPABILITIES,
}
# Between two looks at whether the process that started the server is still there, in seconds.
_LOOK = 5.0
# What is wrong is told again at once if that takes less, else after as long: keys that come
# meanwhile cost nothing.
_AT_ONCE = 0.05
_LONGEST_PAUSE = 0.5


def serve(reader: Reader, writer: Writer) -> int:
    """Answer one client until it is gone; return the exit code that the protocol asks for."""
    server = Server(Connection(reader, writer))
    try:
        return server.run()
    except OSError:
        return 1  # the client does not listen any more


class Server:
    """Takes messages one after the other, each with all its consequences."""

    def __init__(self, connection: Connection) -> None:
        self._connection = connection
        self._session = Session(connection)
        self._initialized = self._shut_down = False
        self._client: int | None = None
        self._duration = 0.0
        self._dirty = False

    def run(self) -> int:
        """Answer until the client says so, or is gone."""
        while True:
            try:
                message = self._connection.receive(self._pause())
            except TimeoutError:
                if self._dirty:
                    self._tell()
                elif not self._client_lives():
                    return 1
                continue
            if message is None:
                return 0 if self._shut_down else 1
            if isinstance(message, dict) and message.get("method") == "exit":
                return 0 if self._shut_down else 1
            self._take(message)
            if self._dirty and not self._session.models.waiting:
                self._tell()  # the work is done, for the answer that was just given
            if self._connection.idle:
                self._connection.cancelled.clear()

    def _pause(self) -> float:
        """How long to wait for a message before there is something else to do."""
        if not self._dirty:
            return _LOOK
        return 0.0 if self._duration < _AT_ONCE else min(self._duration, _LONGEST_PAUSE)

    def _take(self, message: object) -> None:
        """Answer a message, if it wants an answer."""
        if isinstance(message, RequestError):
            self._refuse(None, message)
        elif not isinstance(message, dict):
            self._refuse(None, RequestError(rpc.INVALID_REQUEST, "this is no message"))
        elif "method" not in message:
            pass  # an answer to what was asked of the client
        elif "id" in message:
            self._answer(message["id"], message["method"], message.get("params"))
        else:
            self._hear(message["method"], message.get("params"))

    def _answer(self, identity: Any, method: Any, params: Any) -> None:
        try:
            if not isinstance(identity, (int, str)):
                identity = None
                raise RequestError(rpc.INVALID_REQUEST, "the id is no number and no text")
            if identity in self._connection.cancelled:
                raise RequestError(rpc.CANCELLED, "cancelled")
            result = self._result(method, params)
            self._connection.send({"id": identity, "result": result})
        except RequestError as error:
            self._refuse(identity, error)
        except OSError:
            raise
        except Exception as error:
            self._refuse(identity, RequestError(rpc.INTERNAL_ERROR, _failure(method, error)))

    def _result(self, method: Any, params: Any) -> Any:
        if method == "initialize":
            return self._initialize(_object(params))
        if not self._initialized or self._shut_down:
            raise RequestError(rpc.NOT_INITIALIZED, "the server is not initialized, or shut down")
        if method == "shutdown":
            self._shut_down = True
            return None
        answer = REQUESTS.get(method) if isinstance(method, str) else None
        if answer is None:
            raise RequestError(rpc.METHOD_NOT_FOUND, f"there is no method `{method}`")
        return answer(self._session, _object(params))

    def _initialize(self, params: Json) -> Json:
        if self._initialized:
            raise RequestError(rpc.INVALID_REQUEST, "the server is initialized already")
        self._initialized = True
        encoding = self._session.agree(params.get("capabilities"))
        self._session.take_options(params.get("initializationOptions"))
        process = params.get("processId")
        self._client = process if isinstance(process, int) and process > 0 else None
        lifecycle.open_folders(self._session, params)
        return {
            "capabilities": {**_CAPABILITIES, "positionEncoding": encoding},
            "serverInfo": {"name": "swarmc", "version": __version__},
        }

    def _hear(self, method: Any, params: Any) -> None:
        hear = lifecycle.NOTIFICATIONS.get(method) if isinstance(method, str) else None
        if hear is None or not self._initialized or self._shut_down:
            return
        try:
            self._dirty |= hear(self._session, _object(params))
        except RequestError as error:
            self._session.log(f"{method}: {error}")
        except OSError:
            raise
        except Exception as error:
            self._session.log(_failure(method, error))

    def _tell(self) -> None:
        self._dirty = False
        start = time.perf_counter()
        try:
            self._session.tell()
        except OSError:
            raise
        except Exception as error:
            self._session.log(_failure("diagnostics", error))
        self._duration = time.perf_counter() - start

    def _refuse(self, identity: Any, error: RequestError) -> None:
        self._connection.send(
            {"id": identity, "error": {"code": error.code, "message": str(error)}}
        )

    def _client_lives(self) -> bool:
        """Whether the process that started the server is there, as far as it was named."""
        if self._client is None or sys.platform == "win32":
            return True
        try:
            os.kill(self._client, 0)
        except ProcessLookupError:
            return False
        except OSError:
            pass  # it belongs to somebody else
        return True


def _object(params: Any) -> Json:
    if params is None:
        return {}
    if not isinstance(params, dict):
        raise RequestError(rpc.INVALID_PARAMS, "the params are no object")
    return params


def _failure(method: object, error: Exception) -> str:
    """Note a mistake of the server itself, for its log; return it in short."""
    traceback.print_exc(file=sys.stderr)
    return f"{method}: internal error: {type(error).__name__}: {error}"
