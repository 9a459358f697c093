"""Session of a user in VS Code with the search-and-rescue example."""

from __future__ import annotations

import re
import shutil
import sys
from pathlib import Path

import pytest

from swarmdsl import __version__

pytest.importorskip("playwright", reason="no playwright: `make vscode`")

from playwright.sync_api import Locator, expect

from ...server.flows import FUNCTIONS, GIVEN, MODEL
from ...server.patrol import PATROL
from .typing import fill, write_patrol
from .window import Window

pytestmark = pytest.mark.timeout(900)  # on a busy machine, each step may take two minutes

# Transitions are highlighted only briefly, so the page records them.
NOTE_TAKEN = """picture => {
  const note = ({ target }) => {
    if (target.matches(".taken")) picture.dataset.taken = target.dataset.id;
  };
  const watch = new MutationObserver((all) => all.forEach(note));
  watch.observe(picture, { attributeFilter: ["class"], subtree: true });
}"""
PAIR = """package pair

function try_it : abstraction { service "try_it" : std_srvs/Empty }

endless statemachine Work {
  initial Trying
  state Trying {
    do try_it
    on succeeded -> Waiting
    on aborted -> Trying
  }
  state Waiting {
    after 1 s -> Trying
  }
}
member Worker { behavior Work }
swarm Pair { worker : Worker[2] }

property OneWaits of Pair : never all worker in Waiting
"""
UNTITLED = "statemachine M { initial Idle state Idle { on Nowhere -> Idle } }"
# Declared and named states have scopes, and colours, of their own.
COLOURED = """colour =>
  [...document.querySelectorAll(".editor-instance .view-line span span")].some(each =>
    each.textContent.trim() === "Idle" && getComputedStyle(each).color === colour)"""
WRONG = """[[test]]
name  = "rovers bid at once"
steps = [{ send = "MissionStart" }, { all = "rover", in = "Mission.Rescue.Bid" }]

[[test]]
name  = "time passes"
steps = [{ pass = "1 s" }]
"""
SLOW = """[[test]]
name    = "quick"
machine = "RoverRescue"
steps   = [{ in = "Bid", for = "1 s" }]

[[test]]
name  = "slow one"
seeds = 10000
steps = [{ send = "MissionStart" }, { pass = "30 min" }]
"""
LAMPS = Path(__file__).resolve().parents[2] / "debugger" / "lamps.swarm"
# The project of the example has another swarm, too.
PATROLLED = """swarm = "Patrols"

[[test]]
name  = "a round that fails ends at home"
steps = [
  { send = "Start" },
  { all = "rover", in = "Round" },
  { end = "go_round", of = "rover[0]", as = "aborted" },
  { who = "rover[0]", in = "Home" },
  { who = "rover[1]", in = "Round" },
]
"""
PICTURES = Path(__file__).resolve().parents[3] / "docs" / "pictures"


def text(window: Window, name: str) -> str:
    return (window.folder / name).read_text(encoding="utf-8")


def photograph(window: Window, config: pytest.Config, folder: Path, name: str) -> None:
    """Take screenshots in light and dark; with `--bless`, store them in the documentation."""
    blesses = config.getoption("--bless")
    folder = PICTURES if blesses else folder
    for scheme, theme in (("light", "vs"), ("dark", "vs-dark")):
        window.page.emulate_media(color_scheme=scheme)
        expect(window.page.locator(f".monaco-workbench.{theme}")).to_have_count(1)
        if blesses:
            window.page.wait_for_timeout(1000)  # fading elements
        window.page.screenshot(path=folder / f"{name}-{scheme}.png")
    window.page.emulate_media(color_scheme="light")


def unfolded(window: Window, view: str, name: str) -> Locator:
    """Unfold a row of a view of the debugger, if it is folded; return all its rows."""
    rows = window.page.locator(f".debug-{view} .monaco-list-row")
    row = rows.filter(has_text=name).first
    expect(row).to_be_visible()
    if row.get_attribute("aria-expanded") == "false":
        row.locator(".monaco-tl-twistie").click()
    return rows


def test_bundled_server_runs_with_any_python(window: Window) -> None:
    window.open("behaviours.swarm")
    window.server(__version__)
    window.found("the extension")
    expect(window.status("swarmdsl.swarm.swarmdsl")).to_contain_text(__version__)


def test_hover(window: Window) -> None:
    window.place("behaviours.swarm", "uav_coverage(")
    hover = window.page.locator(".monaco-hover .hover-contents", has_text="Sweep the whole area")
    window.again(lambda: window.command("Show or Focus Hover"), hover.last)
    expect(hover.last).to_be_visible()


def test_definition(window: Window) -> None:
    window.place("behaviours.swarm", "uav_coverage(")
    window.again(lambda: window.press("F12"), window.tab("functions.swarm"))
    line = text(window, "functions.swarm").split("\n").index("function uav_coverage : swarm {") + 1
    window.at(line, len("function ") + 1)
    expect(window.tab("functions.swarm")).to_have_count(1)


def test_references(window: Window) -> None:
    window.place("behaviours.swarm", "MissionStart")
    window.press("Shift+F12")
    rows = window.page.locator(".zone-widget .monaco-list-row")
    for line in (
        "event MissionStart :",
        "on MissionStart -> TakeOff",
        "on MissionStart -> Mission",
    ):
        expect(rows.filter(has_text=line)).not_to_have_count(0)
    window.press("Escape")


def test_completion(window: Window) -> None:
    window.place("behaviours.swarm", "Coverage", after="on succeeded -> ")
    window.press("Control+Space")
    rows = window.page.locator(".suggest-widget .monaco-list-row")
    expect(rows.filter(has_text="SelectRover")).to_have_count(1)
    window.press("Escape")


def test_names_are_in_the_list_while_one_types(window: Window) -> None:
    (window.folder / "flying.swarm").write_text(FUNCTIONS, encoding="utf-8")
    (window.folder / "patrol.swarm").write_text(GIVEN, encoding="utf-8")
    files = window.page.locator(".explorer-folders-view .monaco-list-row")
    files.filter(has_text="patrol.swarm").dblclick()
    window.at(1, 1)
    fill(window)
    window.saved("patrol.swarm", lambda now: now == MODEL)
    assert text(window, "patrol.swarm") == MODEL


@pytest.mark.thorough
def test_patrol_is_written_with_the_keyboard(
    window: Window, tmp_path: Path, pytestconfig: pytest.Config
) -> None:
    (window.folder / "patrol.swarm").write_text("", encoding="utf-8")
    window.open("patrol.swarm")
    write_patrol(window)
    window.saved("patrol.swarm", lambda now: now == PATROL)
    page = window.page
    for kind in ("error", "warning"):
        expect(page.locator(f".squiggly-{kind}")).to_have_count(0)
    expect(page.locator(".notification-toast")).to_have_count(0)

    window.place("patrol.swarm", "aborted")
    suggested = page.locator(".suggest-widget.visible .monaco-list-row.focused")
    window.again(lambda: window.press("Control+Space"), suggested)
    expect(suggested).to_contain_text("aborted")
    photograph(window, pytestconfig, tmp_path, "patrol")
    window.press("Escape")

    (window.folder / "patrol.swarmtest.toml").write_text(PATROLLED, encoding="utf-8")
    window.command("Testing: Focus on Test Explorer View")
    row = page.locator(".test-explorer .monaco-list-row", has_text="patrol.swarmtest.toml")
    expect(row).to_have_count(1)
    window.command("Test: Run All Tests")
    expect(row.locator(".codicon-testing-passed-icon")).to_have_count(1)
    window.command("View: Show Explorer")


def test_file_without_a_name_has_diagnostics_and_colours_of_the_user(window: Window) -> None:
    rule = {"scope": "entity.name.type.state.swarm", "settings": {"foreground": "#ff0000"}}
    with window.settings({"editor.tokenColorCustomizations": {"textMateRules": [rule]}}):
        window.command("File: New Untitled Text File")
        window.command("Change Language Mode")
        window.page.get_by_placeholder("Select Language Mode").fill("Swarm")
        window.choose("Swarm")
        window.focus()
        window.page.keyboard.insert_text(UNTITLED)
        expect(window.page.locator(".squiggly-error").first).to_be_visible()
        # The semantic tokens of the server are there, and have the scopes of the grammar.
        window.page.wait_for_function(COLOURED, arg="rgb(255, 0, 0)")
        window.focus()
        window.command("View: Revert and Close Editor")
        window.leave()


def test_error_has_a_squiggle_and_a_quick_fix(window: Window) -> None:
    before = text(window, "behaviours.swarm")
    window.place("behaviours.swarm", "Coverage", after="on succeeded -> ")
    for _ in range(4):
        window.press("ArrowRight")
    window.press("Delete")
    window.page.keyboard.type("a")
    expect(window.page.locator(".squiggly-error").first).to_be_visible()
    expect(window.problems().filter(has_text="no state called")).to_have_count(1)
    window.focus()
    window.mend()
    expect(window.page.locator(".action-widget .focused")).to_contain_text("Coverage")
    window.press("Enter")
    expect(window.page.locator(".squiggly-error")).to_have_count(0)
    window.saved("behaviours.swarm", lambda now: now == before)


def test_rename_across_files(window: Window) -> None:
    window.place("behaviours.swarm", "uav_coverage(")
    window.rename("sweep_all")
    expect(window.line("do sweep_all(altitude")).to_have_count(1)
    window.saved("functions.swarm", lambda now: "function sweep_all : swarm {" in now)
    window.saved(
        "behaviours.swarm", lambda now: "do sweep_all(" in now and "uav_coverage" not in now
    )


def test_formatting(window: Window) -> None:
    before = text(window, "sar.swarm")
    file = window.folder / "sar.swarm"
    file.write_text(re.sub(r"^  ", "       ", before, flags=re.MULTILINE), encoding="utf-8")
    window.open("sar.swarm")
    window.saved(
        "sar.swarm", lambda now: now == before, again=lambda: window.command("Format Document")
    )
    assert file.read_text(encoding="utf-8") == before


def test_outline(window: Window) -> None:
    window.open("behaviours.swarm")
    window.command("Explorer: Focus on Outline View")
    rows = window.page.locator(".outline-pane .monaco-list-row")
    for name in ("MissionStart", "UavSearchstate machine"):
        expect(rows.filter(has_text=name)).to_have_count(1)


def test_pictures(window: Window, tmp_path: Path, pytestconfig: pytest.Config) -> None:
    before = text(window, "behaviours.swarm")
    window.place("behaviours.swarm", "ing", after="on succeeded -> Track")
    window.command("Explorer: Focus on Outline View")
    window.focus()
    window.press("Delete")
    expect(window.problems().filter(has_text="no state called")).to_have_count(1)
    window.focus()
    if pytestconfig.getoption("--bless"):
        window.page.wait_for_timeout(3000)  # lenses appear later
    window.mend()
    photograph(window, pytestconfig, tmp_path, "vscode")
    window.press("Enter")
    window.saved("behaviours.swarm", lambda now: now == before)


def test_extracted_states_are_named_by_the_user(window: Window) -> None:
    window.place("behaviours.swarm", "Coverage {")
    entry = window.page.locator(".rename-box input")

    def extract() -> None:
        window.press("Control+Shift+r")
        action = window.page.locator(".action-widget .monaco-list-row", has_text="composite state")
        action.first.click()
        expect(entry).to_have_value("CoverageGroup")

    window.again(extract, entry)
    entry.fill("Sweep")
    entry.press("Enter")
    expect(entry).to_be_hidden()
    window.saved("behaviours.swarm", lambda now: "state Sweep {" in now)
    assert "on succeeded -> Sweep.Coverage\n" in text(window, "behaviours.swarm")


def test_reference_lens(window: Window) -> None:
    window.open("behaviours.swarm")
    lens = window.page.locator(".codelens-decoration a", has_text="1 reference").first
    window.again(lens.click, window.page.locator(".zone-widget"))
    window.press("Escape")
    expect(window.page.locator(".zone-widget")).to_have_count(0)


def test_preview_follows_the_text_and_opens_places(
    window: Window, tmp_path: Path, pytestconfig: pytest.Config
) -> None:
    window.place("behaviours.swarm", "Bid {")
    window.command("Swarm: Preview")
    page = window.view()
    page.locator("#which").select_option("RoverRescue.statechart")
    picture = page.locator("#picture")
    expect(picture).to_contain_text("Bid")
    expect(picture.locator(".marked")).to_contain_text("Bid")

    fold = page.locator(".fold[data-of='Mission']")
    fold.click()
    expect(picture).not_to_contain_text("Bid")
    fold.click()
    expect(picture).to_contain_text("Bid")

    picture.get_by_text("Drive", exact=True).click()
    line = text(window, "behaviours.swarm").split("\n").index("      state Drive {") + 1
    window.at(line, len("      state ") + 1)
    expect(picture.locator(".marked")).to_contain_text("Drive")

    window.rename("Travel")
    expect(picture.get_by_text("Travel", exact=True)).to_be_visible()
    window.page.keyboard.type("!")
    expect(page.locator("#state")).to_contain_text("showing the last valid version")
    expect(picture.get_by_text("Travel", exact=True)).to_be_visible()
    window.press("Backspace")
    expect(page.locator("#state")).to_be_empty()
    window.saved("behaviours.swarm", lambda now: "state Travel {" in now)
    photograph(window, pytestconfig, tmp_path, "preview")

    # Another program changes a file that is not open; the model is valid before and after.
    page.locator("#which").select_option("SearchAndRescue.composition")
    expect(picture).to_contain_text("1..5")
    changed = text(window, "sar.swarm").replace("Rover[1..5]", "Rover[1..6]")
    (window.folder / "sar.swarm").write_text(changed, encoding="utf-8")
    expect(picture).to_contain_text("1..6")


def test_names_in_tests_are_checked(window: Window) -> None:
    wrong = WRONG.replace("Rescue.Bid", "Rescue.Bud")
    (window.folder / "names.swarmtest.toml").write_text(wrong, encoding="utf-8")
    window.open("names.swarmtest.toml")
    expect(window.problems().filter(has_text="no state called").first).to_be_visible()


def test_tests_run_in_the_test_view(window: Window) -> None:
    wrong = window.folder / "wrong.swarmtest.toml"
    wrong.write_text(WRONG, encoding="utf-8")
    page = window.page
    window.command("Testing: Focus on Test Explorer View")
    rows = page.locator(".test-explorer .monaco-list-row")
    passed, failed = (f".codicon-testing-{each}-icon" for each in ("passed", "failed"))
    row = rows.filter(has_text="wrong.swarmtest.toml")
    # The bundled server lists and runs them.
    expect(rows).to_have_count(2)
    row.locator(".monaco-tl-twistie").click()
    test = rows.filter(has_text="rovers bid at once")
    expect(rows).to_have_count(4)

    window.place("behaviours.swarm", "on MissionStart -> Mission")
    window.press("F9")
    window.command("Testing: Focus on Test Explorer View")
    test.hover()
    test.locator(".codicon-testing-debug-icon").click()
    expect(page.locator(".debug-top-stack-frame-line")).not_to_have_count(0)
    window.command("Debug: Continue")
    why = "wrong.swarmtest.toml:3: expected all `rover` in `Mission.Rescue.Bid`"
    expect(page.locator(".exception-widget")).to_contain_text(why)
    window.command("Debug: Continue")
    window.command("Testing: Focus on Test Explorer View")
    expect(test.locator(failed)).to_have_count(1)
    expect(rows.locator(passed)).to_have_count(0)
    window.command("Remove All Breakpoints")

    window.command("Test: Run All Tests with Coverage")
    expect(test.locator(failed)).to_have_count(1)
    expect(rows.filter(has_text="time passes").locator(passed)).to_have_count(1)
    expect(rows.filter(has_text="mission.swarmtest.toml").locator(passed)).to_have_count(1)

    test.dblclick()  # it opens the failure
    expect(window.tab("wrong.swarmtest.toml")).to_have_count(1)
    told = page.get_by_role("treeitem", name="expected all `rover` in `Mission.Rescue.Bid`, at")
    expect(told.first).to_be_visible()
    window.open("behaviours.swarm", 40)
    hit = page.locator(".line-numbers.coverage-deco-hit")
    expect(hit.filter(has_text=re.compile("^40$"))).to_have_count(1)  # on aborted -> SelectRover
    window.open("behaviours.swarm", 37)
    expect(hit.filter(has_text=re.compile("^37$"))).to_have_count(1)  # state SelectRover
    expect(hit.filter(has_text=re.compile("^36$"))).to_have_count(0)

    window.leave()
    test.click(button="right")
    item = page.locator(".monaco-menu").get_by_text("Execute Using Profile...")
    expect(item).to_be_visible()
    profiles = page.locator(".quick-input-list .monaco-list-row", has_text="Play")
    # A menu that has just opened ignores clicks.
    window.again(lambda: item.is_visible() and item.click(), profiles.first)
    window.choose("Play")
    run = window.view()
    expect(run.locator("#about")).to_contain_text("SearchAndRescue")
    expect(run.locator("body")).to_contain_text("SW1101")

    window.leave()
    window.open("sar.swarm")
    window.command("Swarm: Run Tests")
    run = window.view()
    expect(run.locator("#about")).to_contain_text("SearchAndRescue")
    terminal = page.locator(".terminal-wrapper .xterm-rows", has_text="1 failed")
    expect(terminal).not_to_have_count(0)

    window.leave()
    window.command("Testing: Focus on Test Explorer View")
    wrong.write_text(f"{WRONG}steps = [", encoding="utf-8")
    expect(rows.filter(has_text="is not valid TOML")).to_have_count(1)
    expect(test).to_have_count(1)  # it does not vanish
    wrong.rename(window.folder / "again.swarmtest.toml")
    expect(rows.filter(has_text="again.swarmtest.toml")).not_to_have_count(0)
    expect(row).to_have_count(0)
    (window.folder / "again.swarmtest.toml").unlink()
    expect(rows).to_have_count(1)
    window.command("View: Show Explorer")


def test_tests_run_on_save_until_they_are_cancelled(window: Window) -> None:
    (window.folder / "slow.swarmtest.toml").write_text(SLOW, encoding="utf-8")
    window.command("Testing: Focus on Test Explorer View")
    rows = window.page.locator(".test-explorer .monaco-list-row")
    icons = {each: f".codicon-testing-{each}-icon" for each in ("passed", "failed", "skipped")}
    rows.filter(has_text="slow.swarmtest.toml").locator(".monaco-tl-twistie").click()
    quick, slow = (rows.filter(has_text=each) for each in ("quick", "slow one"))
    quick.hover()
    quick.get_by_role("button", name="Turn on Continuous Run").click()
    window.open("sar.swarm")  # an input has the files of the one before, and this one is new
    for before, state, result in (("Bid", "Idle", "passed"), ("Idle", "Ready", "failed")):
        window.place("slow.swarmtest.toml", before)
        window.press("Control+Shift+ArrowRight")
        window.page.keyboard.insert_text(state)
        window.saved("slow.swarmtest.toml", lambda now, state=state: f'"{state}"' in now)
        expect(quick.locator(icons[result])).to_have_count(1)
    window.command("Test: Stop Continuous Run")

    slow.hover()
    slow.locator(".codicon-testing-run-icon").click()
    expect(slow.locator(".codicon-loading")).to_have_count(1)
    window.command("Test: Cancel Test Run")
    expect(slow.locator(icons["skipped"])).to_have_count(1)
    window.command("View: Show Explorer")


def test_a_simulation_is_debugged(window: Window) -> None:
    window.command("View: Show Explorer")
    shutil.copy(LAMPS, window.folder)
    expect(window.page.locator(".explorer-folders-view").get_by_text("lamps.swarm")).to_be_visible()
    window.open("sar.swarm")
    window.place("lamps.swarm", "on Start")
    window.press("F9")
    expect(window.page.locator(".codicon-debug-breakpoint")).not_to_have_count(0)
    expect(window.first_command("Simulate")).to_have_text("Swarm: Simulate")
    window.command("Swarm: Debug")
    window.choose("swarm")
    window.choose("No scenario")
    page = window.view()
    bar = page.locator("#debug")
    expect(page.locator("#which")).to_have_value("Lamp.statechart")
    expect(page.locator("#picture .lit")).to_contain_text("Waiting")

    bar.get_by_role("button", name="Start", exact=True).click()
    bar.get_by_label("Data of Start").fill('{"times": 2}')
    bar.get_by_role("button", name="Send", exact=True).click()
    yellow = window.page.locator(".debug-top-stack-frame-line")
    expect(yellow).not_to_have_count(0)
    who = bar.get_by_label("Robot to look at")
    expect(who).to_have_value("1")
    expect(bar.locator(".where")).to_contain_text("at 0.000 s")
    window.command("View: Show Run and Debug")
    frames = unfolded(window, "call-stack", "bulb[0]")
    expect(frames.filter(has_text="on Start [event.times > 0")).not_to_have_count(0)
    rows = unfolded(window, "variables", "Variables")
    expect(rows.filter(has_text="blinks")).to_contain_text("0")

    window.command("Debug: Step Into")
    expect(rows.filter(has_text="blinks")).to_contain_text("2")
    bar.get_by_role("button", name="Continue").click()
    expect(who).to_have_value("2")
    bar.get_by_role("button", name="Back").click()
    expect(page.locator("#picture .lit", has_text="On")).not_to_have_count(0)
    bar.get_by_role("button", name="End").click()
    expect(bar).to_be_hidden()
    expect(page.locator("#picture .lit")).to_have_count(0)
    window.command("Remove All Breakpoints")
    window.command("View: Show Explorer")


def test_markdown_blocks_are_highlighted(window: Window) -> None:
    window.open("NOTES.md")
    block, prose = (window.line("state Idle").nth(each) for each in range(2))
    expect(block.locator("span span").first).to_have_text("state")
    assert block.locator("span span").first.get_attribute("class") != prose.locator(
        "span span"
    ).first.get_attribute("class")


def test_new_model(window: Window) -> None:
    window.command("Swarm: New Model...")
    path = window.folder / "Night Watch.swarm"
    window.choose_file(path)
    expect(window.tab("Night Watch.swarm")).to_have_count(1)
    assert "package night_watch\n" in path.read_text(encoding="utf-8")


def test_first_steps(window: Window) -> None:
    window.command("Swarm: Get Started")
    steps = window.page.locator(".gettingStartedSlideDetails")
    expect(steps.get_by_role("heading", name="Get Started with Swarm")).to_be_visible()
    expect(steps.get_by_role("heading", name="Verify it")).to_be_visible()
    window.command("Swarm: New Project...")
    told = window.page.locator(".notification-toast", has_text="To create a project")
    told.get_by_role("button", name="Install swarmc").click()
    window.choose("New environment")
    consent = window.page.locator(".monaco-dialog-box", has_text="Install swarmc?")
    expect(consent).to_contain_text("swarmdsl.zip")
    window.press("Escape")
    expect(consent).to_have_count(0)
    assert not (window.folder / ".venv").exists()


def test_invalid_server_path_is_reported(window: Window) -> None:
    window.open("behaviours.swarm")
    with window.settings({"swarmdsl.server.path": "/bin/false"}):
        told = window.page.locator(".notification-toast", has_text="/bin/false is not a swarmc")
        expect(told.get_by_role("button", name="Select Interpreter")).to_be_visible()
        expect(window.status("swarmdsl.swarm.swarmdsl").locator(".codicon-warning")).to_be_visible()
        window.command("Testing: Focus on Test Explorer View")
        rows = window.page.locator(".test-explorer .monaco-list-row")
        why = rows.filter(has_text="The tests cannot be read. /bin/false is not a swarmc")
        window.again(rows.first.locator(".monaco-tl-twistie").click, why)
        told.get_by_role("button", name="Open Settings").click()
        expect(window.page.locator(".settings-editor")).to_contain_text(
            "If empty, the extension searches"
        )
        window.press("Escape")
    window.server(__version__)
    expect(why).to_have_count(0)
    window.command("View: Show Explorer")


def test_an_interpreter_is_selected_and_builds_and_simulates(window: Window) -> None:
    """The interpreter is the one that runs these tests."""
    pair = window.folder / "pair.swarm"
    pair.write_text(PAIR, encoding="utf-8")
    window.open("sar.swarm")
    window.server(__version__)
    window.command("Swarm: Simulate")
    told = window.page.locator(".notification-toast", has_text="install the Python package")
    expect(told.get_by_role("button", name="Debug")).to_be_visible()
    told.get_by_role("button", name="Select Interpreter").click()
    window.choose("Browse...")
    window.choose_file(Path(sys.executable))
    try:
        window.found("the setting swarmdsl.server.interpreter")
        window.server(__version__)
        window.command("Swarm: Simulate")
        window.choose("mission.toml")
        summary = window.page.locator(".terminal-wrapper .xterm-rows", has_text="never taken")
        expect(summary).not_to_have_count(0)

        window.command("Swarm: Play Run")
        window.choose("mission.toml")
        run = window.view()
        expect(run.locator("#about")).to_contain_text("scenario mission.toml, seed 4, 5 members")
        run.get_by_role("button", name="step on").click()
        expect(run.locator("#controls .said")).to_contain_text("uav[1]: start")

        window.leave()  # lenses of the server before have no commands any more
        window.place("sar.swarm", "OnGround of")
        lens = window.page.locator(".codelens-decoration a", has_text="Check in simulation").first
        window.again(lens.click, window.page.locator(".quick-input-title", has_text="Scenario"))
        window.choose("mission.toml")
        verdict = window.page.locator(".terminal-wrapper .xterm-rows", has_text="verdict")
        expect(verdict.last).to_contain_text(re.compile(r"OnGround\s+true"))

        window.place("pair.swarm", "OneWaits of")
        lenses = window.page.locator(".codelens-decoration", has_text="Check in simulation")
        rows = window.page.locator(".terminal-wrapper .xterm-rows")
        asked = rows.filter(has_text="OneWaits").first
        window.again(lenses.locator("a", has_text="Verify").first.click, asked)
        shown = rows.filter(has_text=re.compile(r"worker\[1\]\s+do\.Trying\.succeeded"))
        expect(shown).not_to_have_count(0)
        wrong = window.view()
        expect(wrong.locator("#about")).to_contain_text("Pair, 2 members")
        wrong.get_by_role("tab", name="Properties").first.click()
        expect(wrong.locator("#panels")).to_contain_text("OneWaits")
        pair.unlink()
        window.leave()

        window.place("sar.swarm", "OnGround of")
        holds = window.page.locator(".notification-toast", has_text="OnGround: holds")
        window.again(lenses.locator("a", has_text="Verify").first.click, holds.first)

        window.command("Swarm: Follow ROS 2 Nodes...")
        window.answer("Follow ROS 2 Nodes", "/sar")
        told = window.page.locator(".notification-toast", has_text="cannot follow ROS 2 nodes")
        expect(told).to_contain_text("source the setup file of ROS 2")

        window.command("Swarm: Simulate in Real Time")
        window.choose("mission.toml")
        page = window.view()
        expect(page.locator("#which")).to_have_value("UavSearch.statechart")
        expect(page.locator("#picture .lit")).not_to_have_count(0)
        page.locator("#picture").evaluate(NOTE_TAKEN)
        expect(page.locator("#picture")).to_have_attribute("data-taken", re.compile("->"))
        window.command("Tasks: Terminate Task")
        window.choose("simulate")
    finally:
        shutil.rmtree(window.folder / ".vscode")
