# SPDX-License-Identifier: Apache-2.0
"""What is picked on a page, against the first hit of the engine on the same ray."""

import numpy as np


def check_pick(pick, t, t_plane=None):
    """`t`: of the engine's first hit; `t_plane`: where the ray meets the exact plane of the named face. The first hit must
    be in the named face's triangle that was hit, up to rounding."""
    eye = np.array(pick["eye"])
    way = np.array(pick["to"]) - eye
    a, b, c = (np.array(p) for p in pick["corners"])
    normal = np.cross(b - a, c - a)
    if t_plane is None:
        t_plane = np.dot(normal, a - eye) / np.dot(normal, way)
    if t is None or abs(t - t_plane) > 1e-6 * abs(t_plane):
        raise SystemExit(f"face {pick['face']} at {t_plane}, the engine's first hit at {t}")
    point = eye + t * way
    weights = [np.dot(np.cross(q - p, point - p), normal) for p, q in ((a, b), (b, c), (c, a))]
    if min(weights) < -1e-4 * np.dot(normal, normal):
        raise SystemExit(f"face {pick['face']}: the engine's first hit {point} is not in its triangle")
