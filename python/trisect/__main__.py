# SPDX-License-Identifier: Apache-2.0
"""``python -m trisect`` is the trisect command."""
from ._command import main

main()
