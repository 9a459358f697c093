"""Actions in an editor as messages to the server."""

from lsprotocol import types as lsp

from .model import MODEL


class Editor:
    """Opens and edits files through a client; records the diagnostics."""

    def __init__(self, client):
        self.client = client
        self._open = {}

    def open(self, path, text=None):
        """Open a file; return its text document identifier."""
        text = path.read_text(encoding="utf-8") if text is None else text
        uri = path if isinstance(path, str) else path.as_uri()
        document = lsp.TextDocumentItem(uri=uri, language_id="swarm", version=1, text=text)
        self.client.text_document_did_open(lsp.DidOpenTextDocumentParams(text_document=document))
        self._open[uri] = 1
        return lsp.TextDocumentIdentifier(uri=uri)

    def type(self, document, *changes):
        """Replace the text, or ranges of it."""
        self._open[document.uri] = version = self._open.get(document.uri, 0) + 1
        self.client.text_document_did_change(
            lsp.DidChangeTextDocumentParams(
                text_document=lsp.VersionedTextDocumentIdentifier(
                    uri=document.uri, version=version
                ),
                content_changes=[
                    lsp.TextDocumentContentChangeWholeDocument(text=each)
                    if isinstance(each, str)
                    else lsp.TextDocumentContentChangePartial(range=each[0], text=each[1])
                    for each in changes
                ],
            )
        )

    def close(self, document):
        self._open.pop(document.uri, None)
        self.client.text_document_did_close(lsp.DidCloseTextDocumentParams(text_document=document))

    def close_all(self):
        for uri in list(self._open):
            self.close(lsp.TextDocumentIdentifier(uri=uri))

    def changed_on_disk(self, path, how=lsp.FileChangeType.Changed):
        change = lsp.FileEvent(uri=path.as_uri(), type=how)
        self.client.workspace_did_change_watched_files(
            lsp.DidChangeWatchedFilesParams(changes=[change])
        )

    async def told(self, document):
        """Return the diagnostics of a file after all messages sent so far."""
        return await self.told_of(document.uri)

    async def told_of(self, uri):
        uri = uri if isinstance(uri, str) else uri.as_uri()
        # Diagnostics are published after the first answer and before the second one.
        for _ in range(2):
            await self.client.workspace_symbol_async(lsp.WorkspaceSymbolParams(query="\0"))
        return list(self.client.diagnostics.get(uri, []))


def at(word, text=MODEL, inside=1):
    """Return the UTF-16 position `inside` characters after the start of a word."""
    return position(text, text.index(word) + inside)


def position(text, offset):
    before = text[:offset]
    line = before.rpartition("\n")[2]
    return lsp.Position(line=before.count("\n"), character=len(line.encode("utf-16-le")) // 2)


def named(found, text=MODEL):
    """Return the text of single-line UTF-16 ranges."""
    lines = [line.encode("utf-16-le") for line in text.split("\n")]
    return [
        lines[r.start.line][2 * r.start.character : 2 * r.end.character].decode("utf-16-le")
        for r in found
    ]
