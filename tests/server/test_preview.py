"""Tests of the request for diagrams."""

import pytest

from .model import MODEL

pytestmark = pytest.mark.asyncio(loop_scope="module")


async def pictures(client, document, **wanted):
    params = {"textDocument": {"uri": document.uri}, **wanted}
    answer = await client.protocol.send_request_async("swarmdsl/pictures", params)
    return answer if isinstance(answer, dict | None) else answer._asdict()


async def test_pictures_follow_what_is_typed(client, editor, folder):
    document = editor.open(folder / "patrol.swarm")
    answer = await pictures(client, document, id="Patrol.statechart")
    assert answer["id"] == "Patrol.statechart"
    assert ">Round</text>" in answer["svg"]
    assert f'data-place="{folder / "patrol.swarm"}:' in answer["svg"]
    editor.type(document, MODEL.replace("Round", "Circle"))
    assert ">Circle</text>" in (await pictures(client, document, id="Patrol.statechart"))["svg"]
    editor.type(document, MODEL.replace("-> Home", "-> Hone", 1))
    assert await pictures(client, document) == {"broken": 1}


async def test_closed_file_has_no_pictures(client, editor, folder):
    document = editor.open(folder / "patrol.swarm")
    editor.close(document)
    assert await pictures(client, document) is None
