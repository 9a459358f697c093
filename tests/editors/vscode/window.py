"""VS Code window in a browser, with the actions of a user.

The selectors are those of VS Code 1.139; its page has no stable ones.
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

# Timeout of an action of a page in milliseconds; busy machines are slow.
PATIENCE = 120_000
# An action without visible effect after this time is repeated: a busy page may lose keys.
_SOON = 10_000
SIZE = {"width": 1280, "height": 800}
_SETTINGS = {
    "chat.disableAIFeatures": True,
    "editor.cursorBlinking": "solid",
    "editor.minimap.enabled": False,
    "extensions.ignoreRecommendations": True,
    "git.enabled": False,
    "telemetry.telemetryLevel": "off",
    "terminal.integrated.gpuAcceleration": "off",  # until the page shows its text
    "update.mode": "none",
    "window.autoDetectColorScheme": True,
    "workbench.layoutControl.enabled": False,
    "workbench.reduceMotion": "on",  # each frame of an animation takes a processor
    # Late changes of focus must not close an input.
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
    """Window with its user actions; `folder` is the open folder."""

    def __init__(self, page: Page, folder: Path) -> None:
        self.page = page
        self.folder = folder
        self.press = page.keyboard.press

    def again(self, act: Callable[[], object], seen: Locator) -> None:
        """Repeat an action until an element is visible."""
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
        """Run a command by its title in the command palette."""
        self._pick("F1", f">{title}", title)

    def open(self, name: str, line: int = 1, column: int = 1) -> None:
        """Open a file of the folder at a position."""
        self._pick("Control+p", f"{name}:{line}:{column}", name)
        expect(self.tab(name)).to_have_count(1)
        self.at(line, column)

    def _pick(self, key: str, text: str, title: str) -> None:
        """Type into the input opened by a key, and choose an item by its title."""
        row = self._asked.locator(
            ".monaco-list-row", has=self.page.get_by_text(title, exact=True)
        ).first
        self.again(lambda: self._ask(key, text), row)
        row.click()
        # The next item to choose is not in this list, which stays for a moment.
        expect(row).to_be_hidden()

    def _ask(self, key: str, text: str) -> None:
        """Type into the input opened by a key."""
        if self._asked.count():
            self.press("Escape")  # an open input keeps its list of files
            expect(self._asked).to_have_count(0, timeout=_SOON)
        self.press(key)
        self._entry.fill(text, timeout=_SOON)

    def first_command(self, text: str) -> Locator:
        """Return the command that the palette finds first for a text."""
        first = self._asked.locator(".monaco-list-row[data-index='0'] .label-name")
        self.again(lambda: self._ask("F1", f">{text}"), first.filter(has_text=text))
        return first

    def focus(self) -> None:
        """Return to the text."""
        self.command("View: Focus Active Editor Group")
        self._focused()

    def _focused(self) -> None:
        """Wait until the text has the focus."""
        expect(self.page.locator(".editor-instance .monaco-editor.focused")).to_have_count(1)

    def mend(self) -> None:
        """Show the quick fixes at the cursor and apply the first one."""
        first = self.page.locator(".action-widget .monaco-list-row.focused")
        self.again(lambda: self.press("Control+."), first)

    def rename(self, name: str) -> None:
        """Rename the element at the cursor.

        VS Code drops a rename if something moves the cursor before the edits are there.
        """
        self.again(lambda: self._rename(name), self.line(name).first)

    def _rename(self, name: str) -> None:
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
        """Type into an input in the middle of the window and confirm it."""
        # The command palette has an input, too, until it is closed.
        expect(self._asked.locator(".quick-input-title")).to_have_text(title)
        self._entry.fill(text)
        self._entry.press("Enter")
        expect(self._asked).to_have_count(0)

    def choose(self, text: str) -> None:
        """Choose an item of an open list in the middle of the window."""
        self._asked.locator(".monaco-list-row", has_text=text).first.click()

    def choose_file(self, path: Path) -> None:
        """Enter a file name in a file dialog."""
        # Input before the dialog has listed its first folder is replaced; an Enter before it has
        # listed the folder of the file applies to the list shown.
        self._lists([".."])
        self._entry.fill(str(path))
        self._lists([each.name for each in path.parent.iterdir()])
        self._entry.press("Enter")
        expect(self._asked).to_have_count(0)

    def _lists(self, names: Sequence[str]) -> None:
        """Wait until a file dialog lists one of these names."""
        name = re.compile(f"^({'|'.join(map(re.escape, names))})/?$")
        expect(self._asked.locator(".monaco-list-row").get_by_text(name).first).to_be_visible()

    def leave(self) -> None:
        """Close inputs and all files; there are no unsaved changes."""
        deadline = time.monotonic() + PATIENCE / 1000
        while self._asked.count():
            assert time.monotonic() < deadline, self._asked.inner_text()
            # Do not wait: it may be closing.
            self._entry.evaluate_all("all => all.forEach(each => each.focus())")
            self.press("Escape")
        self.command("View: Close All Editors")
        expect(self.page.locator(".tab")).to_have_count(0)

    def tab(self, name: str) -> Locator:
        """Return the tab of a file, if it is active."""
        return self.page.locator(f".tab.active[data-resource-name='{name}']")

    def at(self, line: int, column: int) -> None:
        """Wait until the cursor is at a position and has the focus."""
        expect(self.status("status.editor.selection")).to_contain_text(f"Ln {line}, Col {column}")
        self._focused()

    def place(self, name: str, text: str, after: str = "") -> None:
        """Open a file at the first `text` after the first `after`."""
        whole = (self.folder / name).read_text(encoding="utf-8")
        offset = whole.index(text, whole.index(after))
        before = whole[:offset]
        self.open(name, before.count("\n") + 1, len(before) - before.rfind("\n"))

    def status(self, item: str) -> Locator:
        """Return an item of the status bar."""
        return self.page.locator(f'.statusbar-item[id="{item}"]')

    def server(self, version: str) -> None:
        """Wait until the language server runs."""
        item = self.status("swarmdsl.swarm.swarmdsl")
        expect(item.locator(".codicon-check")).to_be_visible()
        expect(item).to_contain_text(f"swarmc {version}")

    def found(self, origin: str) -> None:
        """Wait until the status item shows the origin of the server."""
        item = self.status("swarmdsl.swarm.swarmdsl")
        expect(item.locator(f"[aria-label*='{origin}']")).to_have_count(1)

    def view(self) -> FrameLocator:
        """Return the content of a webview."""
        return self.page.frame_locator("iframe.webview.ready").frame_locator("#active-frame")

    def line(self, text: str) -> Locator:
        """Return the visible lines with a text."""
        return self.page.locator(".editor-instance .view-line", has_text=_spaced(text))

    def saved(
        self, name: str, right: Callable[[str], bool], again: Callable[[], object] | None = None
    ) -> None:
        """Save all files until one has the expected content; edits may arrive late.

        VS Code drops edits if something moves in the editor before they arrive: `again` asks for
        them anew.
        """
        file = self.folder / name
        deadline = time.monotonic() + PATIENCE / 1000
        while not right(file.read_text(encoding="utf-8")):
            assert time.monotonic() < deadline, file.read_text(encoding="utf-8")
            if again is not None:
                again()
            self.command("File: Save All Files")
            self.page.wait_for_timeout(100)

    @contextmanager
    def settings(self, settings: Mapping[str, object]) -> Iterator[None]:
        """Apply settings to the folder while the context lasts."""
        file = self.folder / ".vscode" / "settings.json"
        file.parent.mkdir(exist_ok=True)
        file.write_text(json.dumps(settings), encoding="utf-8")
        try:
            yield
        finally:
            file.write_text("{}", encoding="utf-8")

    def problems(self) -> Locator:
        """Return the rows of the problems view, files and diagnostics."""
        self.command("Problems: Focus on Problems View")
        return self.page.locator(".markers-panel .monaco-list-row")


def _spaced(text: str) -> re.Pattern[str]:
    """Match a text as the page shows it, with non-breaking spaces."""
    return re.compile(re.escape(text).replace("\\ ", "[ \u00a0]"))


@contextmanager
def opened(
    host: Path, chromium: str, extension: Path, folder: Path, scratch: Path
) -> Iterator[Window]:
    """Serve a folder with a separate VS Code and an extension, and open it in a browser."""
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
        "PATH": "/usr/bin:/bin",  # without the environment of these tests
        "SHELL": "/bin/sh",
        "LANG": "C.UTF-8",
        "EXTENSIONS_GALLERY": "{}",  # else the page asks for one
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
        # Processes of extensions outlive their window.
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
