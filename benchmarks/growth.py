"""Measure how the work grows with the model: each phase, for each kind of model."""

from __future__ import annotations

import gc
import os
import re
import resource
import sys
import json
from collections.abc import Callable
from io import StringIO
from math import log
from pathlib import Path
from time import process_time

from growing import FAMILIES, MODEL, Family, Files

from swarmdsl.cli import run
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.syntax.parse import parse


def write(folder: Path, files: Files) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder / MODEL


def moved(files: Files, digit: str) -> Files:
    """Rename each state and each declaration whose number ends with a digit."""
    return {
        name: re.sub(rf"\b(S|A|M|R|K|T|f_|E)(\d*{digit})\b", r"\1\2x", text)
        for name, text in files.items()
    }


def command(*words: str) -> None:
    code = run(words)
    if code not in OK:
        raise SystemExit(f"{code}: {' '.join(words)}")

OK = {0, 1}

TARGETS = "scxml adf smach ros2 skeleton yasmin amf swarmros parameters composition".split()


class Prepared:
    def __init__(self, folder: Path, family: Family, count: int):
        self.folder = folder
        files = family(count)
        self.model = str(write(folder / "model", files))
        self.files = files
        self.old = str(write(folder / "seven", moved(files, "7")))
        self.theirs = str(write(folder / "three", moved(files, "3")))
        self.ugly = str(write(folder / "ugly", {n: t.replace("  ", " ").replace(" : ", ":") for n, t in files.items()}))


def phase_parse(p):
    def go():
        for name, text in p.files.items():
            report = Diagnostics()
            parse(Source(name, text), report)
            assert not report.has_errors, list(report)[0].message
    return go

def phase_check(p): return lambda: command("check", p.model)
def phase_fmt(p): return lambda: command("fmt", "--check", p.ugly)
def target(name): return lambda p: lambda: command("build", p.model, "--target", name, "-o", str(p.folder / "out" / name))
def diagram(fmt): return lambda p: lambda: command("diagram", p.model, "--format", fmt, "-o", str(p.folder / f"dia-{fmt}"))
def phase_doc(p): return lambda: command("doc", p.model, "-o", str(p.folder / "doc.html"))
def phase_diff(p): return lambda: command("diff", p.old, p.model)
def phase_merge(p): return lambda: command("merge", p.model, p.old, p.theirs, "-o", str(p.folder / "merged.swarm"))
def phase_rename(p): return lambda: command("rename", "Go", "Went", p.model, "--dry-run")
def phase_import(p):
    out = p.folder / "scxml"
    child(lambda: command("build", p.model, "--target", "scxml", "-o", str(out)))
    docs = [str(each) for each in sorted(out.rglob("*.scxml")) if "cpswarm" not in str(each)]
    assert docs, list(out.rglob("*"))
    return lambda: command("import", "scxml", *docs, "-o", str(p.folder / "imported.swarm"), "--dry-run")
def phase_simulate(p): return lambda: command("simulate", p.model, "--until", "10ms", "--trace", "none")
def phase_lsp(p):
    return None

PHASES = {"parse": phase_parse, "check": phase_check, "fmt": phase_fmt, **{t: target(t) for t in TARGETS},
  **{f: diagram(f) for f in ("svg", "mermaid", "dot", "plantuml")}, "doc": phase_doc, "diff": phase_diff, "merge": phase_merge, "rename": phase_rename, "import": phase_import, "simulate": phase_simulate}


def child(go: Callable[[], None], limit=60) -> tuple[float, float, str]:
    """CPU seconds, MB."""
    read, write_ = os.pipe()
    pid = os.fork()
    if pid == 0:
        code = 1
        try:
            resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 1))
            os.close(read)
            null = os.open(os.devnull, os.O_WRONLY)
            os.dup2(null, 1); 
            if not os.environ.get("SHOW"): os.dup2(null, 2)
            gc.disable()
            start = process_time()
            go()
            took = process_time() - start
            os.write(write_, json.dumps([took, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024]).encode())
            code = 0
        except BaseException as e:
            try: os.write(write_, json.dumps(["error", repr(e)[:500]]).encode())
            except: pass
        finally:
            os._exit(code)
    os.close(write_)
    with os.fdopen(read, "rb") as stream:
        data = stream.read()
    os.waitpid(pid, 0)
    if not data: return (float("inf"), 0)
    found = json.loads(data)
    if found[0] == "error": raise RuntimeError(found[1])
    return found


def main():
    import tempfile
    fams = os.environ.get("FAM", "").split(",") if os.environ.get("FAM") else list(FAMILIES)
    phs = os.environ.get("PH", "").split(",") if os.environ.get("PH") else list(PHASES)
    factor = int(os.environ.get("FACTOR", 4)); 
    base_n = int(os.environ.get("N", 250))
    rounds = int(os.environ.get("ROUNDS", 2))
    with tempfile.TemporaryDirectory() as d:
        d = Path(d)
        # import everything once
        warm = Prepared(d / "warm", FAMILIES["members"], 3)
        sys.stdout.flush()
        save = os.dup(1), os.dup(2)
        null = os.open(os.devnull, os.O_WRONLY); os.dup2(null, 1); os.dup2(null, 2)
        for ph in phs:
            PHASES[ph](warm)()
        os.dup2(save[0], 1); os.dup2(save[1], 2)
        gc.collect(); gc.freeze()
        for fam in fams:
            ps = [Prepared(d / f"{fam.replace(' ','_')}{n}", FAMILIES[fam], n) for n in (2, base_n, base_n * factor)]
            row = []
            for ph in phs:
                try:
                    gos = [PHASES[ph](p) for p in ps]
                    ts = []
                    for go in gos:
                        ts.append(min(child(go)[0] for _ in range(rounds)))
                    mem = child(gos[2])[1] if False else 0
                    a, b = ts[1] - ts[0], ts[2] - ts[0]
                    e = log(b / a) / log(factor) if a > 0 and b > 0 else 0
                    if b < 0.02: e = 0
                    row.append(f"{ph} {e:.2f}{'***' if e > 1.2 else ''} ({ts[2]*1e3:.0f}ms)")
                except Exception as x:
                    row.append(f"{ph} ERR {x}")
            print(f"{fam:30}", " | ".join(row), flush=True)
main()
