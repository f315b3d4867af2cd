"""A copy of the repository for trying changes.

    python3 ci/copied_tree.py FOLDER
"""

import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent


def copy_tree(folder):
    """Makes a folder hold exactly the files of the repository.

    What has not changed is not written again, so that what was built from it stays good; what a run that was stopped has
    left changed is, so that it is built anew.
    """
    command = ["git", "ls-files", "--cached", "--others", "--exclude-standard"]
    listing = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True)
    wanted = {line for line in listing.stdout.splitlines() if (ROOT / line).is_file()}
    folder.mkdir(parents=True, exist_ok=True)
    for path in [path for path in folder.rglob("*") if path.is_file() and str(path.relative_to(folder)) not in wanted]:
        path.unlink()
    for line in sorted(wanted):
        source, place = ROOT / line, folder / line
        if not place.exists() or place.read_bytes() != source.read_bytes():
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_bytes(source.read_bytes())
            place.chmod(source.stat().st_mode)


if __name__ == "__main__":
    copy_tree(pathlib.Path(sys.argv[1]))
