# SPDX-License-Identifier: Apache-2.0
"""Exceptions of the package.

The compiled module raises these; each message says what was wrong and where.
"""
from __future__ import annotations

from typing import TYPE_CHECKING, Optional

if TYPE_CHECKING:
    from ._trisect import Report


class Error(Exception):
    """Base of all exceptions that the library raises on purpose."""


class UsageError(Error, ValueError):
    """A call that makes no sense: a wrong shape, an index out of range, a number that is not finite."""


class InputError(Error, ValueError):
    """A file that cannot be read or does not follow its format; the message names file, line and column."""


class InvalidSolid(Error, ValueError):
    """Well-formed data that does not bound a solid.

    Attributes
    ----------
    report : Report or None
        All findings, with the vertices, faces and places of each.
    """

    report: Optional[Report] = None


class LimitError(Error, ValueError):
    """A limit was reached: of work, memory, or the range of coordinates."""


class CancelledError(Error):
    """``progress`` returned False."""


class UnsupportedError(Error):
    """A valid request that this version cannot carry out, such as the mesh of a half-space."""


class InternalError(Error, RuntimeError):
    """A broken promise of the library. Please report it."""
