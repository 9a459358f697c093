"""XMPP, by which the tools of CPSwarm speak to each other: bodies of messages in and out.

A manager says in its presence what it can do, and asks the orchestrator and the optimizer to follow
it. Files of a configuration are taken and not kept: the model and its scenarios are here.
"""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from queue import Queue
from threading import Event, Thread
from typing import Any
from xml.etree import ElementTree

from slixmpp import ClientXMPP
from slixmpp.xmlstream.handler import Callback
from slixmpp.xmlstream.matcher import MatchXPath

from swarmdsl.execution.experiments.failures import StoppedError
from swarmdsl.execution.experiments.serving.messages import configured_text, status_text

PEERS = ("orchestrator", "frevo")
"""Accounts of the orchestrator and of the optimizer, as its `orchestrator.xml` names them."""
_RESOURCE = "cpswarm"
_PORT = 5222
_OFFER = "http://jabber.org/protocol/si"
_ACCEPTED = f"""<si xmlns="{_OFFER}"><feature xmlns="http://jabber.org/protocol/feature-neg">
<x xmlns="jabber:x:data" type="submit"><field var="stream-method">
<value>http://jabber.org/protocol/ibb</value></field></x></feature></si>"""
"""Answer to an offer of a file, as XEP-0095 and XEP-0096 have it."""
_WAIT = 10
"""Seconds to log in."""


class Account(ClientXMPP):  # type: ignore[misc]  # slixmpp has no types
    """Account of a simulation manager, in a thread of its own."""

    def __init__(self, address: str, password: str) -> None:
        self._address = address
        name, _, port = address.partition(":")
        self._port = int(port or _PORT)
        # An event loop belongs to its thread.
        self._own_loop = asyncio.new_event_loop()
        asyncio.set_event_loop(self._own_loop)
        super().__init__(f"{name}/{_RESOURCE}", password)
        self._got: Queue[tuple[Any, str] | str] = Queue()
        """Messages with their senders, or the reason of the end."""
        self._sender: Any = None
        self._is_ready = Event()
        self._failure = "the server does not answer"
        self.register_plugin("xep_0030")
        # Files come through the server, which works without an open port.
        self.register_plugin("xep_0047", {"auto_accept": True})
        for feature in (_OFFER, f"{_OFFER}/profile/file-transfer"):
            self.plugin["xep_0030"].add_feature(feature)
        path = MatchXPath(f"{{jabber:client}}iq/{{{_OFFER}}}si")
        self.register_handler(Callback("offers of files", path, self._accept))
        for event, handle in (
            ("session_start", self._begin),
            ("message", self._take),
            ("ibb_stream_end", self._configured),
            ("failed_all_auth", lambda _: self._end("the server refuses the password")),
            (
                "ssl_invalid_chain",
                lambda _: self._end("the certificate of the server is not trusted"),
            ),
            ("connection_failed", self._note),
            ("disconnected", lambda _: self._end("the connection was closed")),
        ):
            self.add_event_handler(event, handle)

    def lines(self) -> Iterator[str]:
        """Log in, and yield the bodies of messages. Raises StoppedError at the end."""
        Thread(target=self._run, daemon=True).start()
        if not self._is_ready.wait(_WAIT) and self._got.empty():
            self._end(self._failure)
        while True:
            got = self._got.get()
            if isinstance(got, str):
                help_ = (
                    "the password is in `SWARMDSL_XMPP_PASSWORD`; accounts are those of the server"
                )
                raise StoppedError("no-connection", help_, address=self._address, reason=got)
            self._sender, body = got
            yield body

    def write(self, text: str) -> None:
        """Answer the message that was yielded last."""
        to, body = self._sender, text.rstrip("\n")
        self._call(lambda: self.send_message(mto=to, mbody=body, mtype="chat"))

    def flush(self) -> None:
        """Nothing waits to be written."""

    def _call(self, action: Any) -> None:
        self._own_loop.call_soon_threadsafe(action)

    def _run(self) -> None:
        asyncio.set_event_loop(self._own_loop)
        self.connect(self.boundjid.host, self._port)
        self._own_loop.run_forever()

    def _end(self, reason: str) -> None:
        self._got.put(reason)

    def _note(self, error: Any) -> None:
        # Another address of the server may answer.
        self._failure = str(error) or self._failure

    async def _begin(self, _: Any) -> None:
        self.send_presence(pstatus=status_text())
        await self.get_roster()
        for peer in PEERS:
            self.send_presence_subscription(pto=f"{peer}@{self.boundjid.host}")
        self._is_ready.set()

    def _take(self, message: Any) -> None:
        # Errors come from the server, and the orchestrator's word for one needs no answer.
        if message["type"] in ("chat", "normal") and message["body"].strip() not in ("", "error"):
            self._got.put((message["from"], message["body"].replace("\n", " ")))

    def _accept(self, offer: Any) -> None:
        """Accept a file; slixmpp's own plugin for it answers nothing."""
        if offer["type"] == "set":
            answer = offer.reply()
            answer.append(ElementTree.fromstring(_ACCEPTED))
            answer.send()

    def _configured(self, stream: Any) -> None:
        body = configured_text()
        self.send_message(mto=stream.peer_jid, mbody=body, mtype="chat")
