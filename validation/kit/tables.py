"""Tables in Markdown, and the versions of the packages that made them."""

import importlib.metadata


def markdown(head, rows):
    """Table with a line for the head, one below it, and one for each row."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(str(cell) for cell in line) + " |" for line in lines) + "\n"


def versions(packages=("pong", "mujoco", "drake", "pybullet", "numpy")):
    """Names and versions of those packages that are installed."""
    found = []
    for name in packages:
        try:
            found.append(f"{name} {importlib.metadata.version(name)}")
        except importlib.metadata.PackageNotFoundError:
            continue
    return ", ".join(found)
