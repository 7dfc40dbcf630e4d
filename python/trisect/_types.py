# SPDX-License-Identifier: Apache-2.0
"""Names of types that several modules of the package use."""
from typing import Literal

#: What is known about a mesh meeting itself, see `trisect.Solid`.
Embedding = Literal["assume", "check", "resolve"]
