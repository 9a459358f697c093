"""Makes the Python of ROS interfaces without catkin. Run by the Python that has ROS: PACKAGES OUT.

PACKAGES is a folder of packages with `msg`, `srv` and `action`; OUT gets their Python packages.
"""

import subprocess
import sys
from pathlib import Path

from genpy.generate_initpy import write_modules
from genpy.generator import MsgGenerator, SrvGenerator

SHARE = Path("/usr/share")
GENACTION = "/usr/lib/actionlib_msgs/genaction.py"


def main(packages: Path, out: Path) -> int:
    found = sorted(path for path in packages.iterdir() if path.is_dir())
    for package in found:
        for action in sorted(package.glob("action/*.action")):
            command = [sys.executable, GENACTION, str(action), "-o", str(package / "msg")]
            subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    search = {path.parent.name: [str(path)] for path in SHARE.glob("*/msg")}
    search.update({package.name: [str(package / "msg")] for package in found})
    failed = 0
    for package in found:
        for kind, generator in (("msg", MsgGenerator()), ("srv", SrvGenerator())):
            files = [str(file) for file in sorted(package.glob(f"{kind}/*.{kind}"))]
            if not files:
                continue
            folder = out / package.name / kind
            folder.mkdir(parents=True, exist_ok=True)
            (out / package.name / "__init__.py").touch()
            failed |= generator.generate_messages(package.name, files, str(folder), search)
            write_modules(str(folder))
    return failed


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), Path(sys.argv[2])))
