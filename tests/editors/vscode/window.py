"""A window of Visual Studio Code in a browser, and what a person does in it.

The selectors are those of Code 1.139, whose page has no others that are promised.
"""

from __future__ import annotations

import json
import os
import re
import signal
import socket
import subprocess
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

from playwright.sync_api import (
    Error,
    FrameLocator,
    Locator,
    Page,
    expect,
    sync_playwright,
)

from . import environment

# Of what a page does, in milliseconds: machines that do other things besides are slow.
PATIENCE = 120_000
# After which what shows nothing is done again: keys may be lost while a page does other things.
_SOON = 10_000
SIZE = {"width": 1280, "height": 800}
_SETTINGS = {
    "chat.disableAIFeatures": True,
    "editor.minimap.enabled": False,
    "extensions.ignoreRecommendations": True,
    "git.enabled": False,
    "telemetry.telemetryLevel": "off",
    "terminal.integrated.gpuAcceleration": "off",  # so that the page has its text
    "update.mode": "none",
    "window.autoDetectColorScheme": True,
    "workbench.layoutControl.enabled": False,
    # What comes into focus late does not close what asks for something.
    "workbench.quickOpen.closeOnFocusLost": False,
    "workbench.preferredDarkColorTheme": "Default Dark Modern",
    "workbench.preferredLightColorTheme": "Default Light Modern",
    "workbench.secondarySideBar.defaultVisibility": "hidden",
    "workbench.startupEditor": "none",
}
_BROWSER = [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-background-networking",
    "--disable-component-update",
    "--host-resolver-rules=MAP * ~NOTFOUND , EXCLUDE 127.0.0.1",
]


class Window:
    """What a person sees and does; `folder` is the one that is open."""

    def __init__(self, page: Page, folder: Path) -> None:
        self.page = page
        self.folder = folder
        self.press = page.keyboard.press

    def again(self, act: Callable[[], object], seen: Locator) -> None:
        """Do something until it is seen."""
        deadline = time.monotonic() + PATIENCE / 1000
        while True:
            try:
                act()
                expect(seen).to_be_visible(timeout=_SOON)
                return
            except (AssertionError, Error):
                if time.monotonic() > deadline:
                    raise

    def command(self, title: str) -> None:
        """Run a command by its title, as the palette has it."""
        self._pick("F1", f">{title}", title)

    def open(self, name: str, line: int = 1, column: int = 1) -> None:
        """Open a file of the folder, with the cursor at a place in it."""
        self._pick("Control+p", f"{name}:{line}:{column}", name)
        expect(self.tab(name)).to_have_count(1)
        self.at(line, column)

    def _pick(self, key: str, text: str, title: str) -> None:
        """Write into the field that a key opens, and choose what it lists by its title."""
        row = self._asked.locator(
            ".monaco-list-row", has=self.page.get_by_text(title, exact=True)
        ).first

        def ask() -> None:
            self.press(key)
            self._entry.fill(text, timeout=_SOON)

        self.again(ask, row)
        row.click()

    def focus(self) -> None:
        """Go back to the text."""
        self.command("View: Focus Active Editor Group")
        self._focused()

    def _focused(self) -> None:
        """Wait until keys go to the text."""
        expect(self.page.locator(".editor-instance .monaco-editor.focused")).to_have_count(1)

    def mend(self) -> None:
        """Show the quick fixes at the cursor; the first is chosen."""
        first = self.page.locator(".action-widget .monaco-list-row.focused")
        self.again(lambda: self.press("Control+."), first)

    def rename(self, name: str) -> None:
        """Give what is at the cursor another name."""
        entry = self.page.locator(".rename-box input")
        self.again(lambda: self.press("F2"), entry)
        entry.fill(name)
        entry.press("Enter")
        expect(entry).to_be_hidden()
        self._focused()

    @property
    def _asked(self) -> Locator:
        return self.page.locator(".quick-input-widget:not([style*='display: none'])")

    @property
    def _entry(self) -> Locator:
        return self._asked.locator("input[type=text]")

    def answer(self, title: str, text: str) -> None:
        """Write into a field that opens in the middle, and close it."""
        # The list of commands has one, too, until it has closed.
        expect(self._asked.locator(".quick-input-title")).to_have_text(title)
        self._entry.fill(text)
        self._entry.press("Enter")
        expect(self._asked).to_have_count(0)

    def choose(self, text: str) -> None:
        """Choose what a list offers that has opened in the middle."""
        self._asked.locator(".monaco-list-row", has_text=text).first.click()

    def choose_file(self, path: Path) -> None:
        """Name a file in a dialog that asks for one."""
        # What is written before it has listed the folder that it begins in is replaced by that one;
        # an Enter before it has listed that of the file counts for whatever it lists.
        self._lists([".."])
        self._entry.fill(str(path))
        self._lists([each.name for each in path.parent.iterdir()])
        self._entry.press("Enter")
        expect(self._asked).to_have_count(0)

    def _lists(self, names: Sequence[str]) -> None:
        """Wait until a dialog that asks for a file lists one of these names."""
        name = re.compile(f"^({'|'.join(map(re.escape, names))})/?$")
        expect(self._asked.locator(".monaco-list-row").get_by_text(name).first).to_be_visible()

    def leave(self) -> None:
        """Close what asks for something, and all files; there are no changes to save."""
        deadline = time.monotonic() + PATIENCE / 1000
        while self._asked.count():
            assert time.monotonic() < deadline, self._asked.inner_text()
            # Without waiting for it: it may be closing.
            self._entry.evaluate_all("all => all.forEach(each => each.focus())")
            self.press("Escape")
        self.command("View: Close All Editors")
        expect(self.page.locator(".tab")).to_have_count(0)

    def tab(self, name: str) -> Locator:
        """The tab of a file, if it is in front."""
        return self.page.locator(f".tab.active[data-resource-name='{name}']")

    def at(self, line: int, column: int) -> None:
        """Wait until the cursor is at a place, where keys go."""
        expect(self.status("status.editor.selection")).to_contain_text(f"Ln {line}, Col {column}")
        self._focused()

    def place(self, name: str, text: str, after: str = "") -> None:
        """Open a file with the cursor at the first `text` after the first `after`."""
        whole = (self.folder / name).read_text(encoding="utf-8")
        offset = whole.index(text, whole.index(after))
        before = whole[:offset]
        self.open(name, before.count("\n") + 1, len(before) - before.rfind("\n"))

    def status(self, item: str) -> Locator:
        """An item of the status bar."""
        return self.page.locator(f'.statusbar-item[id="{item}"]')

    def server(self, version: str) -> None:
        """Wait until the language server runs."""
        item = self.status("swarmdsl.swarm.swarmdsl")
        expect(item.locator(".codicon-check")).to_be_visible()
        expect(item).to_contain_text(f"swarmc {version}")

    def found(self, origin: str) -> None:
        """Wait until the server is the one that was found somewhere, as its item says."""
        item = self.status("swarmdsl.swarm.swarmdsl")
        expect(item.locator(f"[aria-label*='{origin}']")).to_have_count(1)

    def view(self) -> FrameLocator:
        """What an extension shows in a view of its own."""
        return self.page.frame_locator("iframe.webview.ready").frame_locator("#active-frame")

    def line(self, text: str) -> Locator:
        """The lines in sight that have a text."""
        return self.page.locator(".editor-instance .view-line", has_text=_spaced(text))

    def saved(self, name: str, right: Callable[[str], bool]) -> None:
        """Save all files until one of them is as it should be: what changes it may come later."""
        file = self.folder / name
        deadline = time.monotonic() + PATIENCE / 1000
        while not right(file.read_text(encoding="utf-8")):
            assert time.monotonic() < deadline, file.read_text(encoding="utf-8")
            self.command("File: Save All Files")
            self.page.wait_for_timeout(100)

    @contextmanager
    def settings(self, settings: Mapping[str, object]) -> Iterator[None]:
        """Set something for the folder, for a while."""
        file = self.folder / ".vscode" / "settings.json"
        file.parent.mkdir(exist_ok=True)
        file.write_text(json.dumps(settings), encoding="utf-8")
        try:
            yield
        finally:
            file.write_text("{}", encoding="utf-8")

    def problems(self) -> Locator:
        """The rows of the view of problems, files and what is wrong in them."""
        self.command("Problems: Focus on Problems View")
        return self.page.locator(".markers-panel .monaco-list-row")


def _spaced(text: str) -> re.Pattern[str]:
    """Match a text as the page has it, where blanks do not break."""
    return re.compile(re.escape(text).replace("\\ ", "[ \u00a0]"))


@contextmanager
def opened(
    host: Path, chromium: str, extension: Path, folder: Path, scratch: Path
) -> Iterator[Window]:
    """Serve a folder by a VS Code of its own, with an extension, and open it in a browser."""
    machine = scratch / "data" / "Machine"
    user = scratch / "data" / "User"
    for settings in (machine, user):
        settings.mkdir(parents=True)
        (settings / "settings.json").write_text(json.dumps(_SETTINGS), encoding="utf-8")
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    program = [
        *(str(environment.node(host)), str(environment.code(host))),
        *("--user-data-dir", str(scratch / "data"), "--extensions-dir", str(scratch / "added")),
    ]
    surroundings = {
        "HOME": str(scratch),
        "PATH": "/usr/bin:/bin",  # without the environment that runs these tests
        "SHELL": "/bin/sh",
        "LANG": "C.UTF-8",
        "EXTENSIONS_GALLERY": "{}",  # else the page asks one
    }
    subprocess.run(
        [*program, "--install-extension", str(extension)],
        env=surroundings,
        check=True,
        capture_output=True,
    )
    serve = [
        *("--auth", "none", "--bind-addr", f"127.0.0.1:{port}", "--disable-telemetry"),
        *("--disable-update-check", "--disable-workspace-trust"),
        *("--disable-getting-started-override", str(folder)),
    ]
    with (scratch / "log.txt").open("wb") as log:
        server = subprocess.Popen(
            [*program, *serve],
            env=surroundings,
            stdout=log,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
    try:
        _wait_for(port)
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(executable_path=chromium, args=_BROWSER)
            expect.set_options(timeout=PATIENCE)
            page = browser.new_page(viewport=SIZE, color_scheme="light")
            page.set_default_timeout(PATIENCE)
            page.goto(f"http://127.0.0.1:{port}/")
            page.wait_for_selector(".explorer-folders-view .monaco-list-row")
            yield Window(page, folder)
            browser.close()
    finally:
        # The processes of extensions live on without their window.
        os.killpg(server.pid, signal.SIGTERM)
        try:
            server.wait(20)
        except subprocess.TimeoutExpired:
            os.killpg(server.pid, signal.SIGKILL)


def _wait_for(port: int) -> None:
    deadline = time.monotonic() + PATIENCE / 1000
    while True:
        try:
            socket.create_connection(("127.0.0.1", port)).close()
            return
        except OSError:
            assert time.monotonic() < deadline, "VS Code does not start"
            time.sleep(0.1)
