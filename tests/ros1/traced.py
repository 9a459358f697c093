"""Runs a generated node and tells which states are active, a line of JSON at each change.

Run by the Python that has ROS: FD PACKAGE SCRIPT. What is told goes to the file descriptor FD.
"""

import importlib
import json
import os
import runpy
import sys
import threading
import time
from pathlib import Path

sys.path.insert(1, str(Path(__file__).resolve().parents[1] / "smach"))
import active


def watch(machine, told):
    before = None
    while True:
        now = [active.paths(machine), active.settled(machine)]
        if now != before:
            before = now
            told.write(json.dumps(now) + "\n")
            told.flush()
        time.sleep(0.003)


def main(descriptor, package, script):
    told = os.fdopen(int(descriptor), "w")
    node = importlib.import_module(f"{package}.node")
    start = node._Runner.start

    def watched(runner):
        threading.Thread(target=watch, args=(runner.machine, told), daemon=True).start()
        start(runner)

    node._Runner.start = watched
    sys.argv = [script, *sys.argv[4:]]
    runpy.run_path(script, run_name="__main__")


if __name__ == "__main__":
    main(*sys.argv[1:4])
