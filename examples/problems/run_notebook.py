# SPDX-License-Identifier: Apache-2.0
"""Runs all cells of a notebook: by nbclient where it is installed, else one after the other.

    python3 run_notebook.py session.ipynb
"""
import ast
import json
import sys


def by_nbclient(path):
    """In a kernel of its own, as Jupyter does. False where the packages are missing."""
    try:
        import ipykernel  # noqa: F401
        import nbclient
        import nbformat
    except ImportError:
        return False
    notebook = nbformat.read(path, as_version=4)
    nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3").execute()
    for cell in notebook.cells:
        for output in cell.get("outputs", []):
            print(output.get("text") or output["data"]["text/plain"])
    return True


def by_hand(path):
    """Cells in one namespace; the value of a last expression is printed, as a notebook shows it."""
    with open(path, encoding="utf-8") as file:
        cells = json.load(file)["cells"]
    names = {"__name__": "__main__"}
    for number, cell in enumerate(cells, 1):
        if cell["cell_type"] != "code":
            continue
        tree = ast.parse("".join(cell["source"]), f"cell {number}")
        last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
        exec(compile(tree, f"cell {number}", "exec"), names)
        if last is not None:
            value = eval(compile(ast.Expression(last.value), f"cell {number}", "eval"), names)
            if value is not None:
                print(repr(value))


if not by_nbclient(sys.argv[1]):
    by_hand(sys.argv[1])
