"""Tests of the preview page, in Chromium: as an editor embeds it, and on its own."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from typing import Any

import pytest

from swarmdsl.driver import pipeline
from swarmdsl.ide.preview.pictures import Pictures, pictures
from swarmdsl.ide.preview.serving import Snapshot, serving

pytestmark = pytest.mark.skipif(
    shutil.which("chromium") is None, reason="no browser: apt-get install chromium"
)

MODEL = """package work
statemachine Rest { initial Nap; state Nap { after 1 s -> Awake } final Awake }
endless statemachine Job {
  initial Out
  state Out {
    initial Dig
    state Dig {
      initial Nap
      state Nap { after 1 s -> Push }
      state Push { after 1 s -> Nap }
    }
    after 9 s -> Home
  }
  state Home { after 2 s -> Out }
}
member Digger { behavior Job }
swarm Team { digger : Digger[2] }
"""
# An editor: it answers requests for diagrams, and keeps the other messages.
EDITOR = """
  window.posted = [];
  window.acquireVsCodeApi = () => ({
    getState: () => undefined,
    setState: () => {},
    postMessage: async (message) => message.want
      ? window.postMessage(await answer(message.want))
      : posted.push(message),
  });
"""
THEME = """([classes, ink, paper]) => {
  document.body.className = classes;
  const style = document.documentElement.style;
  style.setProperty("--vscode-editor-foreground", ink);
  style.setProperty("--vscode-editor-background", paper);
  style.setProperty("--vscode-contrastBorder", ink);
}"""
BLACK, WHITE, NAVY = "rgb(0, 0, 0)", "rgb(255, 255, 255)", "rgb(15, 74, 133)"
FOCUSED = "document.activeElement.closest('.node')?.dataset.id"
SCALE = "Number(/scale\\((.*)\\)/.exec(document.getElementById('picture').style.transform)[1])"
PUSH = "[data-id='Out.Dig.Push']"


class Visit:
    """A page that is open; `embedded` in an editor."""

    def __init__(self, browser: Any, address: str, drawn: Pictures, embedded: bool) -> None:
        self.page = browser.new_page(viewport={"width": 800, "height": 600})
        self.wrong: list[object] = []
        self.page.on("pageerror", lambda error: self.wrong.append(error))
        self.missing: dict[str, Any] = {}
        self.drawn = drawn
        if embedded:
            self.page.expose_function("answer", self._answer)
            self.page.add_init_script(EDITOR)
        self.address = address
        self.press = self.page.keyboard.press
        self.picture = self.page.locator("#picture")
        self.which = self.page.locator("#which")

    def open(self) -> None:
        self.page.goto(self.address)

    def push(self, button: str) -> None:
        self.page.locator(f"#{button}").click()

    def tell(self, **message: object) -> None:
        self.page.evaluate("message => window.postMessage(message)", message)

    def cursor(self, *elements: tuple[str, str], moved: bool = True) -> None:
        found = [{"diagram": diagram, "element": element} for diagram, element in elements]
        self.tell(cursor=found, moved=moved)

    def _answer(self, want: dict[str, Any]) -> dict[str, Any]:
        if self.missing:
            return self.missing
        return {**self.drawn.listed(), **self.drawn.drawn(want["id"], want["folded"])}


@pytest.fixture(scope="module")
def visit(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Any]:
    """Make a page; no page may have had an error."""
    playwright = pytest.importorskip("playwright.sync_api", reason="no playwright: `make vscode`")
    model = tmp_path_factory.mktemp("page") / "work.swarm"
    model.write_text(MODEL, encoding="utf-8")
    made = pictures(pipeline.check([model]))
    assert isinstance(made, Pictures)
    snapshot = Snapshot()
    snapshot.tell(made)
    visits: list[Visit] = []
    with serving(snapshot, 0) as address, playwright.sync_playwright() as driver:
        chromium = driver.chromium.launch(
            executable_path=shutil.which("chromium"), args=["--no-sandbox"]
        )

        def make(*, embedded: bool = True) -> Visit:
            visits.append(Visit(chromium, address, made, embedded))
            return visits[-1]

        yield make
        chromium.close()
    assert [each.wrong for each in visits if each.wrong] == []


@pytest.fixture(scope="module")
def expect(visit: Any) -> Any:
    """Assertions that wait."""
    from playwright.sync_api import expect

    expect.set_options(timeout=60_000)
    return expect


def in_view(visit: Visit, selector: str) -> bool:
    inside = """selector => {
      const [of, view] = [selector, "#view"].map(each =>
        document.querySelector(each).getBoundingClientRect());
      return of.left >= view.left && of.right <= view.right
        && of.top >= view.top && of.bottom <= view.bottom;
    }"""
    return bool(visit.page.evaluate(inside, selector))


def wheel(visit: Visit, expect: Any, x: float, y: float) -> None:
    """Turn the wheel in the middle of the picture until that has an effect."""
    before = visit.picture.get_attribute("style")
    visit.page.mouse.move(400, 300)
    visit.page.mouse.wheel(x, y)
    expect(visit.picture).not_to_have_attribute("style", before)


def test_cursor_selects_the_diagram_and_marks_its_element_only(visit: Any, expect: Any) -> None:
    shown = visit()
    shown.open()
    which, marked = shown.which, shown.picture.locator(".marked")
    expect(which).to_have_value("Team.composition")
    shown.cursor(("Job.statechart", "Out.Dig.Nap"))
    expect(which).to_have_value("Job.statechart")
    expect(marked).to_have_attribute("data-id", "Out.Dig.Nap")
    shown.cursor(("Job.statechart", "Out.Dig.Nap->0"))
    expect(marked).to_have_attribute("data-id", "Out.Dig.Nap->0")
    # The user looks at another machine, with a state of the same name.
    which.select_option("Rest.statechart")
    expect(shown.picture).to_contain_text("Awake")
    expect(marked).to_have_count(0)
    shown.cursor(("Job.statechart", "Out.Dig.Naps"), moved=False)
    shown.tell(broken=3)  # comes after it
    expect(shown.page.locator("#state")).to_contain_text("3 errors")
    expect(which).to_have_value("Rest.statechart")  # edits of the text do not leave it
    shown.cursor(("Rest.statechart", "Nap"))
    expect(marked).to_have_attribute("data-id", "Nap")
    shown.cursor()
    expect(marked).to_have_count(0)
    expect(which).to_have_value("Rest.statechart")

    # A member is in the diagram of its swarm, which stays.
    which.select_option("Team.composition")
    expect(shown.picture).to_contain_text("Digger")
    shown.cursor(("Digger.internal", ""), ("Team.composition", "role.digger"))
    expect(marked).to_have_attribute("data-id", "role.digger")


def test_cursor_comes_into_view(visit: Any, expect: Any) -> None:
    shown = visit()
    shown.open()
    marked = shown.picture.locator(".marked")
    shown.which.select_option("Job.statechart")
    shown.cursor(("Job.statechart", "Home"))
    expect(marked).to_have_attribute("data-id", "Home")
    for _ in range(4):
        shown.push("zoom-in")
    wheel(shown, expect, 3000, 0)
    assert not in_view(shown, f"{PUSH} > text")
    shown.cursor(("Job.statechart", "Out.Dig.Push"))
    expect(marked).to_have_attribute("data-id", "Out.Dig.Push")
    assert in_view(shown, f"{PUSH} > text")
    # It marks the folded state around a hidden one.
    shown.push("fold-all")
    expect(marked).to_have_attribute("data-id", "Out")
    shown.push("unfold-path")
    expect(marked).to_have_attribute("data-id", "Out.Dig.Push")


def test_page_says_why_there_is_no_diagram(visit: Any, expect: Any) -> None:
    shown = visit()
    button = {"title": "Restart Server", "command": "swarmdsl.restartServer"}
    shown.missing = {"unavailable": {"text": "No swarmc found.", "actions": [button]}}
    shown.open()
    told = shown.page.locator("#explanation")
    expect(told).to_contain_text("No swarmc found.")
    told.get_by_role("button", name="Restart Server").click()
    assert shown.page.evaluate("posted") == [{"run": "swarmdsl.restartServer"}]
    shown.tell(broken=2)
    expect(told).to_contain_text("2 errors")
    shown.tell(**shown.drawn.listed(), **shown.drawn.drawn("Rest.statechart"))
    expect(shown.picture).to_contain_text("Awake")
    expect(told).to_be_hidden()
    # The picture stays when the server ends.
    shown.tell(**shown.missing)
    expect(shown.page.locator("#state")).to_have_text("No swarmc found. This is the last version.")
    expect(shown.picture).to_contain_text("Awake")


def test_page_controls_a_debug_session(visit: Any, expect: Any) -> None:
    shown = visit()
    shown.open()
    bar = shown.page.locator("#debug")
    expect(shown.picture).to_contain_text("Digger")
    expect(bar).to_be_hidden()
    event = {"event": "Go", "label": "Go", "to": ["digger[0]"]}
    other = {"event": "Dig", "label": "Dig", "to": ["digger[0]"], "data": {"depth": 0}}
    session = {"held": True, "time": 1.5, "member": "digger[0]", "events": [event, other]}
    shown.tell(debug={**session, "variables": {"holes": "2"}})
    expect(bar.locator(".where")).to_have_text("digger[0], at 1.500 s")
    expect(bar.locator(".values")).to_have_text("holes = 2")
    expect(bar.get_by_role("button", name="Pause")).to_have_count(0)
    expect(bar.get_by_role("button", name="Simulate")).to_have_count(0)  # the editor has that
    bar.get_by_role("button", name="Back").click()
    bar.get_by_role("button", name="Go").click()
    bar.get_by_role("button", name="Dig").click()
    shown.press("Enter")
    expect(bar.get_by_role("button", name="Dig")).to_be_focused()
    dig = {"event": "Dig", "data": {"depth": 0}}
    posted = [{"debug": each} for each in ({"request": "stepBack"}, {"event": "Go"}, dig)]
    assert shown.page.evaluate("posted") == posted
    shown.tell(debug={**session, "members": ["digger[0]", "digger[1]"], "reason": "it is late"})
    expect(bar.locator(".said")).to_have_text("it is late")
    bar.get_by_label("Robot to look at").select_option("digger[1]")
    assert shown.page.evaluate("posted")[-1] == {"debug": {"look": 2}}
    shown.tell(debug={"held": False, "time": 2})
    expect(bar.get_by_role("button", name="Step")).to_be_disabled()
    expect(bar.get_by_role("button", name="Pause")).to_be_enabled()
    expect(bar.locator(".sends")).to_be_hidden()
    shown.tell(debug=None)
    expect(bar).to_be_hidden()


@pytest.mark.parametrize(
    ("classes", "other", "ink", "paper", "own"),
    [
        ("vscode-high-contrast vscode-high-contrast-light", "dark", NAVY, WHITE, WHITE),
        ("vscode-high-contrast", "light", WHITE, BLACK, "rgb(22, 25, 29)"),
    ],
    ids=["light", "dark"],
)
def test_themes_of_high_contrast(
    visit: Any, expect: Any, classes: str, other: str, ink: str, paper: str, own: str
) -> None:
    shown = visit()
    shown.page.emulate_media(color_scheme=other)  # that of the system is not that of the theme
    shown.open()
    shown.which.select_option("Job.statechart")
    expect(shown.picture).to_contain_text("Push")
    shown.page.evaluate(THEME, [classes, ink, paper])
    for part, colour in (("text.name", ink), (".box", paper), (".edge .arrow", ink)):
        expect(shown.picture.locator(part).first).to_have_css("fill", colour)
    # Without colours of the editor, the scheme is still that of the theme.
    shown.page.evaluate(THEME, [classes, "", ""])
    expect(shown.page.locator("body")).to_have_css("background-color", own)
    expect(shown.picture.locator(".box").first).to_have_css("fill", own)


def test_contrast_that_the_system_asks_for(visit: Any, expect: Any) -> None:
    shown = visit(embedded=False)
    shown.page.emulate_media(color_scheme="light", contrast="more")
    shown.open()
    shown.which.select_option("Rest.statechart")
    expect(shown.picture).to_contain_text("Awake")
    for part, colour in (("text.name", BLACK), (".box", WHITE), (".edge .arrow", BLACK)):
        expect(shown.picture.locator(part).first).to_have_css("fill", colour)


def test_search_unfolds_what_hides_a_state(visit: Any, expect: Any) -> None:
    shown = visit(embedded=False)
    shown.open()
    push, found = shown.picture.locator(PUSH), shown.picture.locator(".found")
    note, entry = shown.page.locator("#note"), shown.page.locator("#find")
    shown.which.select_option("Job.statechart")
    expect(push).to_have_count(1)
    shown.push("fold-all")
    expect(push).to_have_count(0)
    shown.page.locator("#view").focus()
    shown.press("/")
    expect(entry).to_be_focused()
    shown.page.keyboard.type("pus")
    shown.press("Enter")
    expect(found).to_have_attribute("data-id", "Out.Dig.Push")
    expect(note).to_have_text("1 of 1")
    for number, id_ in ((1, "Out"), (2, "Home"), (1, "Out")):
        entry.fill("o")
        shown.press("Enter")
        expect(found).to_have_attribute("data-id", id_)
        expect(note).to_have_text(f"{number} of 2")
    entry.fill("nobody")
    shown.press("Enter")
    expect(note).to_have_text("no such name here")
    shown.push("fold-all")
    expect(push).to_have_count(0)
    shown.push("unfold-all")
    expect(push).to_have_count(1)


def test_keys_reach_states_and_wheel_pans(visit: Any, expect: Any) -> None:
    shown = visit()
    shown.open()
    page, push = shown.page, shown.picture.locator(PUSH)
    shown.which.select_option("Job.statechart")
    expect(push).to_have_count(1)
    page.locator("#view").focus()
    shown.press("Tab")
    assert page.evaluate(FOCUSED) is not None
    outer = shown.picture.locator("[data-id='Out']")
    outer.focus()
    expect(outer).to_have_attribute("aria-expanded", "true")
    shown.press("Space")
    expect(push).to_have_count(0)
    assert page.evaluate(FOCUSED) == "Out", "the new picture keeps it"
    shown.press("Space")
    expect(push).to_have_count(1)
    seen = set()
    for key in ("ArrowDown", "ArrowRight", "ArrowUp", "ArrowLeft") * 2:
        shown.press(key)
        seen.add(page.evaluate(FOCUSED))
    assert len(seen) > 2
    shown.picture.locator("[data-id='Home']").focus()
    shown.press("Enter")
    [posted] = page.evaluate("posted")
    assert posted["reveal"].endswith("work.swarm:14:9")

    shown.push("fit")
    fitted = page.evaluate(SCALE)
    wheel(shown, expect, 50, 30)
    assert page.evaluate(SCALE) == fitted
    shown.push("zoom-in")
    assert page.evaluate(SCALE) == pytest.approx(fitted * 1.25, rel=1e-4)
    shown.push("zoom-out")
    assert page.evaluate(SCALE) == pytest.approx(fitted)
    page.keyboard.down("Control")
    wheel(shown, expect, 0, -400)
    page.keyboard.up("Control")
    assert page.evaluate(SCALE) > fitted * 2
