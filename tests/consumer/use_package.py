# SPDX-License-Identifier: Apache-2.0
"""Uses the Python package as it was installed."""
import importlib.metadata
import pathlib
import pickle

import trisect

plate = trisect.Solid.box((0, 0, 0), (4, 3, 1))
part = plate - trisect.Solid.cylinder(0.5, 2).translate((2, 1.5, -0.5))
vertices, faces = part.mesh()
again = pickle.loads(pickle.dumps(trisect.Solid(vertices, faces)))
assert again.triangle_count == len(faces)
assert abs(again.volume - part.volume) < 1e-12
folder = pathlib.Path(trisect.__file__).parent
assert (folder / "py.typed").is_file() and (folder / "_trisect.pyi").is_file()
assert importlib.metadata.version("trisect") == trisect.__version__
print(trisect.__version__, part)
