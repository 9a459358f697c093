"""A page as a person sees it, in a browser."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.cli import run

from .conftest import SAR

playwright = pytest.importorskip("playwright.sync_api", reason="no playwright: `make vscode`")
pytestmark = pytest.mark.skipif(
    shutil.which("chromium") is None, reason="no chromium: apt-get install chromium"
)


class Visit:
    """A page that is open, and what went on while it was."""

    def __init__(self, browser: Any, path: Path, **options: object) -> None:
        self.page = browser.new_page(**options)
        self.wrong: list[str] = []
        self.asked: list[str] = []
        self.page.on("console", lambda message: self.wrong.append(message.text))
        self.page.on("pageerror", lambda error: self.wrong.append(str(error)))
        self.page.on("request", lambda request: self.asked.append(request.url))
        self.address = path.as_uri()
        self.page.goto(self.address)

    def anchor(self) -> str:
        return str(self.page.evaluate("decodeURIComponent(location.hash.slice(1))"))

    def in_view(self, anchor: str) -> None:
        """Wait until an element is in view, at the top of the page or at its end."""
        element = self.page.locator(f'[id="{anchor}"]')
        playwright.expect(element).to_be_in_viewport()
        script = """element => {
            const root = document.documentElement;
            const rest = root.scrollHeight - root.clientHeight - root.scrollTop;
            const top = element.getBoundingClientRect().top;
            return (top >= 0 && top < 100) || rest < 2;
        }"""
        self.page.wait_for_function(script, arg=element.element_handle())


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("page") / "sar page.html"
    assert run(["doc", str(SAR), "-o", str(path)]) == 0
    return path


# Not for longer: while a browser is driven, no test with asyncio runs.
@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with playwright.sync_playwright() as driver:
        options = {"executable_path": shutil.which("chromium"), "args": ["--no-sandbox"]}
        browser = driver.chromium.launch(**options)
        yield browser
        browser.close()


@pytest.fixture
def visit(browser: Any, path: Path) -> Iterator[Visit]:
    visit = Visit(browser, path, viewport={"width": 1200, "height": 800})
    yield visit
    visit.page.close()
    assert visit.wrong == []
    assert {address.partition("#")[0] for address in visit.asked} <= {
        visit.address,
        "about:blank",
        "data:,",
    }


def test_search_leads_to_a_state(visit: Visit) -> None:
    page = visit.page
    page.keyboard.press("/")
    page.keyboard.type("localcov")
    options = page.locator("#page-found li")
    playwright.expect(options.first).to_contain_text("UavSearch.Mission.LocalCoverage")
    playwright.expect(options.first).to_have_attribute("aria-selected", "true")
    options.first.click()
    assert visit.anchor() == "UavSearch.Mission.LocalCoverage"
    visit.in_view("UavSearch.Mission.LocalCoverage")
    playwright.expect(page.locator("#page-found")).to_be_hidden()


def test_search_with_the_keyboard(visit: Visit) -> None:
    page = visit.page
    field = page.get_by_role("combobox")
    field.fill("frequency")
    options = page.locator("#page-found li")
    playwright.expect(options).to_have_count(2)
    first = options.first.text_content()
    page.keyboard.press("ArrowDown")
    playwright.expect(options.nth(1)).to_have_attribute("aria-selected", "true")
    assert field.get_attribute("aria-activedescendant") == options.nth(1).get_attribute("id")
    page.keyboard.press("ArrowUp")
    page.keyboard.press("Enter")
    assert visit.anchor() in first
    assert page.evaluate("document.activeElement.id") == visit.anchor()

    field.fill("uuid of the cps")  # words of the documentation
    playwright.expect(options.first).to_contain_text("cpswarm_msgs/TaskAllocat")
    field.fill("nothing is called so")
    playwright.expect(page.get_by_role("status")).to_have_text("no results")
    page.keyboard.press("Escape")
    playwright.expect(page.get_by_role("status")).to_have_text("")


def test_diagrams_and_links_lead_on(visit: Visit) -> None:
    page = visit.page
    page.locator('[id="RoverRescue"] svg a', has_text="Stuck").first.click()
    assert visit.anchor() == "RoverRescue.Mission.Rescue.Stuck"
    visit.in_view(visit.anchor())
    page.locator('[id="UavSearch.Mission.Coverage"] a', has_text="uav_coverage").click()
    assert visit.anchor() == "uav_coverage"
    visit.in_view("uav_coverage")
    # A message has a name with a `/`.
    page.locator('[id="uav_coverage"] dl a', has_text="cpswarm_msgs/Coverage").click()
    visit.in_view("cpswarm_msgs/Coverage")
    page.go_back()
    # Where the page was scrolled to is up to the browser.
    assert visit.anchor() == "uav_coverage"


PINCH = """picture => {
    const {left, top, width, height} = picture.getBoundingClientRect();
    const touch = (type, pointerId, x) => picture.dispatchEvent(new PointerEvent(type, {
        pointerId, pointerType: "touch", bubbles: true, button: 0,
        clientX: left + width / 2 + x, clientY: top + height / 2}));
    for (const [number, x] of [[1, -20], [2, 20]]) touch("pointerdown", number, x);
    for (const [number, x] of [[1, -40], [2, 40]]) touch("pointermove", number, x);
    for (const number of [1, 2]) touch("pointerup", number, 0);
}"""


def test_diagrams_zoom_and_fold(visit: Visit) -> None:
    page = visit.page
    picture = page.locator('[id="RoverRescue"] > figure .picture')
    picture.scroll_into_view_if_needed()
    figure = page.locator('[id="RoverRescue"] > figure')

    def width() -> float:
        return float(picture.evaluate("picture => picture.querySelector('svg').clientWidth"))

    fitting = width()
    figure.get_by_role("button", name="Zoom in").click()
    assert width() == pytest.approx(1.25 * fitting, rel=0.01)
    picture.focus()
    for key in ("+", "+", "+", "+", "-"):
        page.keyboard.press(key)
    assert width() == pytest.approx(1.25**4 * fitting, rel=0.01)
    assert picture.evaluate("picture => picture.scrollWidth > picture.clientWidth")
    left = picture.evaluate("picture => picture.scrollLeft")
    page.keyboard.press("ArrowRight")
    page.wait_for_function(
        "([picture, left]) => picture.scrollLeft > left", arg=[picture.element_handle(), left]
    )
    page.keyboard.press("0")
    assert width() == fitting
    picture.evaluate(PINCH)
    assert width() == pytest.approx(2 * fitting, rel=0.01)

    states = picture.locator(".node.state")
    before = states.count()
    figure.get_by_role("button", name="Fold states", exact=False).first.click()
    assert 0 < states.count() < before
    picture.focus()
    page.keyboard.press("u")
    assert states.count() == before
    # Dragging is no click, also on a link.
    page.keyboard.press("+")
    link = picture.locator("a", has_text="Stuck").first
    link.hover()
    page.mouse.down()
    page.mouse.move(300, 300, steps=3)
    page.mouse.up()
    assert visit.anchor() == ""


def test_every_state_can_be_linked_to(visit: Visit) -> None:
    page = visit.page
    page.goto("about:blank")
    page.goto(f"{visit.address}#UavSearch.Abort.Landed")
    visit.in_view("UavSearch.Abort.Landed")
    current = page.locator("#page-contents a[aria-current]")
    playwright.expect(current).to_have_text("UavSearch")


def test_colours(browser: Any, path: Path) -> None:
    visit = Visit(browser, path, color_scheme="dark")
    page = visit.page
    painted = "getComputedStyle(document.body).backgroundColor"
    figure = "getComputedStyle(document.querySelector('svg .box')).fill"

    def light() -> list[bool]:
        return [sum(map(int, page.evaluate(of)[4:-1].split(","))) > 384 for of in (painted, figure)]

    assert light() == [False, False]
    page.get_by_role("button", name="Theme").click()
    assert light() == [True, True]
    page.reload()
    assert light() == [True, True]
    page.get_by_role("button", name="Theme").click()
    assert light() == [False, False]
    page.emulate_media(media="print")
    assert light() == [True, True]
    playwright.expect(page.locator("#page-contents")).to_be_hidden()
    page.close()
    assert visit.wrong == []


def test_a_narrow_screen(browser: Any, path: Path) -> None:
    visit = Visit(browser, path, viewport={"width": 390, "height": 800})
    page = visit.page
    assert page.evaluate("document.documentElement.scrollWidth") == 390
    contents = page.locator("#page-contents")
    playwright.expect(contents).to_be_hidden()
    page.get_by_role("button", name="Contents").click()
    contents.get_by_role("link", name="RoverRescue").click()
    visit.in_view("RoverRescue")
    playwright.expect(contents).to_be_hidden()
    page.close()
    assert visit.wrong == []


def test_without_scripts_the_page_is_whole(browser: Any, path: Path) -> None:
    visit = Visit(browser, path, java_script_enabled=False)
    playwright.expect(visit.page.locator("#page-contents")).to_be_visible()
    playwright.expect(visit.page.get_by_role("combobox")).to_be_hidden()
    visit.page.locator("#page-contents").get_by_role("link", name="RoverRescue").click()
    visit.in_view("RoverRescue")
    visit.page.close()


def test_what_assistive_technology_hears(visit: Visit) -> None:
    page = visit.page
    levels = page.evaluate("[...document.querySelectorAll('h1,h2,h3,h4')].map(h => +h.tagName[1])")
    assert levels[0] == 1
    assert levels.count(1) == 1
    assert all(after - before <= 1 for before, after in pairwise(levels))
    for role, name in (("main", None), ("navigation", "Contents"), ("search", None)):
        assert page.get_by_role(role, name=name).count() == 1, role
    page.keyboard.press("Tab")
    playwright.expect(page.get_by_role("link", name="Skip to the content")).to_be_focused()
    for link in page.locator("svg a:not([tabindex])").all():
        assert (link.text_content() or "").strip(), link
    assert page.get_by_role("table", name="Roles").count() == 1
