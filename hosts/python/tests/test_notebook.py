"""The tutorial notebook runs from its first cell to its last."""

import os
import pathlib

import nbformat
from nbclient import NotebookClient

NOTEBOOK = pathlib.Path(os.environ["REPOSITORY"]) / "hosts/python/tutorial.ipynb"


def test_every_cell_runs():
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    assert not any(cell.get("outputs") for cell in notebook.cells), "clear the outputs before you save it"
    NotebookClient(notebook, timeout=300, kernel_name="python3").execute()
    told = "".join(output.get("text", "") for cell in notebook.cells for output in cell.get("outputs", []))
    assert "30 of 30 runs" in told and "bell.ron" in told
