# SPDX-License-Identifier: Apache-2.0
"""Plants of blocks that are hard to divide. All are boxes with whole corners, so what meets is known by comparing them."""
import math
import random

CELL = 100
SCENES = ('beams', 'plane', 'clusters', 'heap', 'few')
GATHERED = {'beams': 60, 'clusters': 4020, 'heap': 2000, 'few': 6000}
PARTS = {'beams': 60000, 'plane': 90000, 'clusters': None, 'heap': 40000, 'few': 20000}
CLUSTERS = 400
COMPARED = 30
UNIT = 64  # the edge of block.off, of which all sizes are doubles


def block(name, low, size, group='blocks'):
    """block.off, scaled."""
    rows = [[size[i] / UNIT if i == j else 0 for j in range(3)] for i in range(3)]
    pose = [value for row, corner in zip(rows, low) for value in (*row, corner)]
    return {'file': 'block.off', 'name': name, 'group': group, 'pose': pose}


class Scene:
    """In cells of 100, with blocks of 60 to 110 that overlap some of their neighbours."""

    def __init__(self, name, parts, gathered, seed):
        self.random = random.Random(seed)
        self.parts, self.sets = [], [{'name': 'all', 'a': 'blocks', 'mode': 'intersection'}]
        getattr(self, name)(parts or PARTS[name], gathered or GATHERED.get(name))

    def size(self):
        return [self.random.randrange(60, 110) for _ in range(3)]

    def grid(self, parts, depth):
        """Blocks in a cube, or in one layer; how many along an edge."""
        side = math.ceil(math.sqrt(parts) if depth == 1 else parts ** (1 / 3))
        for i in range(parts):
            low = [CELL * (i % side), CELL * (i // side % side), CELL * (i // side ** 2)]
            self.parts.append(block(f'block {i}', low, self.size()))
        return side

    def beams(self, parts, beams):
        """Beams across all, one after the other along each axis."""
        edge = CELL * self.grid(parts, None)
        for i in range(beams):
            low = [self.random.randrange(edge) for _ in range(3)]
            size = [50, 50, 50]
            low[i % 3], size[i % 3] = 0, edge
            self.parts.append(block(f'beam {i}', low, size))

    def plane(self, parts, _):
        self.grid(parts, 1)

    def clusters(self, _, largest):
        """The k-th has a k-th of the largest one, in a cube as dense as the others."""
        counts = [largest // k for k in range(1, CLUSTERS + 1)]
        edge = round(CELL * (8 * sum(counts)) ** (1 / 3))
        for k, count in enumerate(counts):
            corner = [self.random.randrange(edge) for _ in range(3)]
            room = round(CELL * count ** (1 / 3)) + 1
            for i in range(count):
                low = [c + self.random.randrange(room) for c in corner]
                self.parts.append(block(f'block {k} {i}', low, self.size()))

    def heap(self, parts, gathered):
        """Many at random in a cube of two and a half times their size; a sixth of all pairs of them overlap."""
        self.grid(parts - gathered, None)
        for i in range(gathered):
            low = [-10000 + self.random.randrange(250) for _ in range(3)]
            self.parts.append(block(f'heap {i}', low, self.size()))

    def few(self, parts, gathered):
        """Many in the same place, of which few are compared with the others."""
        self.grid(parts - gathered, None)
        for i in range(gathered):
            group = 'few' if i * COMPARED // gathered != (i - 1) * COMPARED // gathered else 'gathered'
            self.parts.append(block(f'heap {i}', [-10000, -10000, -10000], [80, 80, 80], group))
        self.sets.append({'name': 'few', 'a': 'few', 'b': ['few', 'gathered'], 'mode': 'intersection'})
