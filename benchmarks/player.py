"""Measure the player: sizes of pages, and what they cost in a browser."""

from __future__ import annotations

import json
import runpy
import shutil
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from measure import Section, process

ROOT = Path(__file__).resolve().parents[1]
LINES = 100_000
MEMBERS = 50
FRAMES = 120

_SWARMC = str(Path(sys.executable).with_name("swarmc"))
_SCRUB = f"""() => new Promise((done) => {{
  const {{ end }} = player.recording;
  let number = 0;
  const frame = () => {{
    if (number++ === {FRAMES}) return done();
    player.goTime((end * number) / {FRAMES});
    requestAnimationFrame(frame);
  }};
  requestAnimationFrame(frame);
}})"""
_MOMENTS = """() => {
  const { recording } = player;
  const start = performance.now();
  for (let number = 1; number <= 500; number++) recording.moment((number * 7919) % recording.count);
  return (performance.now() - start) / 500;
}"""


def section(folder: Path) -> Section:
    """Write the pages of a mission and of a long run, and open them in Chromium."""
    found = Section(
        "`swarmc play`: search and rescue, 20 minutes, and "
        f"{LINES:,} lines of {MEMBERS} members that walk, talk and are lost. Times in Chromium are "
        "processor time of the page.",
        ["page", "size, KB", "opens in, ms", "a moment, ms", "a frame, ms", "memory, MB"],
    )
    model = ROOT / "examples" / "search_and_rescue"
    lines = runpy.run_path(str(ROOT / "tests" / "player" / "lines.py"))["lines_of"]
    trace = folder / "run.jsonl"
    trace.write_text(
        "".join(f"{json.dumps(line)}\n" for line in lines(LINES, MEMBERS)), encoding="utf-8"
    )
    pages = {
        "search and rescue": [str(model), "--scenario", str(model / "mission.toml")],
        f"{LINES:,} lines": ["--trace", str(trace)],
    }
    costs: dict[str, tuple[float, ...]] = {}
    for name, arguments in pages.items():
        page = folder / f"{len(costs)}.html"
        # There, no model is beside the trace.
        process(["env", "-C", str(folder), _SWARMC, "play", *arguments, "-o", str(page)])
        size, cost = page.stat().st_size, _cost(page)
        costs[name] = (size, *cost)
        opens, moment, frame, memory = cost
        found.rows.append(
            [
                name,
                f"{size / 1e3:.0f}",
                f"{opens:.0f}",
                f"{moment:.2f}",
                f"{frame:.1f}",
                f"{memory:.0f}",
            ]
        )
    short, long = costs.values()
    found.goal("search and rescue, in KB", short[0] / 1e3, 250, "{:.0f}")
    found.goal(f"{LINES:,} lines, in MB", long[0] / 1e6, 3, "{:.2f}")
    found.goal(f"{LINES:,} lines open in, in seconds", long[1] / 1e3, 1, "{:.2f}")
    found.goal("a moment of them, in milliseconds", long[2], 5, "{:.2f}")
    found.goal("a frame of scrubbing, in milliseconds", long[3], 1e3 / 60, "{:.1f}")
    found.goal("memory of the script, in MB", long[4], 300, "{:.0f}")
    return found


def _cost(page: Path) -> tuple[float, float, float, float]:
    """Return milliseconds of opening, of a moment and of a frame, and megabytes, of a page."""
    with _tab() as (tab, used):
        tab.goto(page.as_uri())
        tab.wait_for_selector("html[data-ready]", state="attached")
        opened = used("TaskDuration")
        moment = tab.evaluate(_MOMENTS)
        before = used("TaskDuration")
        tab.evaluate(_SCRUB)
        frame = (used("TaskDuration") - before) / FRAMES
        return opened * 1e3, moment, frame * 1e3, used("JSHeapUsedSize") / 1e6


@contextmanager
def _tab() -> Iterator[tuple[Any, Any]]:
    """Yield a tab of Chromium, and what it has used so far by the name of the metric."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as driver:
        browser = driver.chromium.launch(
            executable_path=shutil.which("chromium"), args=["--no-sandbox"]
        )
        tab = browser.new_page(viewport={"width": 1280, "height": 900})
        session = tab.context.new_cdp_session(tab)
        session.send("Performance.enable", {"timeDomain": "threadTicks"})

        def used(name: str) -> float:
            metrics = session.send("Performance.getMetrics")["metrics"]
            return float(next(each["value"] for each in metrics if each["name"] == name))

        yield tab, used
        browser.close()
