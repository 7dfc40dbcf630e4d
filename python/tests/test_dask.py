# SPDX-License-Identifier: Apache-2.0
"""Solids between processes of Dask: they are pickled as native files, so results are the same to the last bit."""
import fractions
import functools
import operator

import pytest

import trisect

distributed = pytest.importorskip('distributed')


def drilled(plate, i):
    hole = trisect.Solid.cylinder(0.25, 4).translate((i + 0.5, 0.5, -1))
    return plate - hole


def ball(radius):
    return trisect.Solid.sphere(radius)


def volume(solid):
    return solid.exact_volume()


@pytest.fixture(scope='module')
def client():
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as made:
            yield made


def test_solids_go_to_workers_and_come_back(client):
    plates = [trisect.Solid.box((i, 0, 0), (i + 1, 1, 1)) for i in range(4)]
    far = client.gather(client.map(drilled, plates, range(4), pure=False))
    near = [drilled(plate, i) for i, plate in enumerate(plates)]
    assert [volume(s) for s in far] == [volume(s) for s in near]
    assert all((a ^ b).is_empty for a, b in zip(far, near))


def test_results_stay_with_workers(client):
    parts = client.map(drilled, [trisect.Solid.box((i, 0, 0), (i + 1, 1, 1)) for i in range(4)], range(4), pure=False)
    pairs = [client.submit(operator.or_, parts[i], parts[i + 1], pure=False) for i in (0, 2)]
    whole = client.submit(operator.or_, *pairs, pure=False)
    alone = functools.reduce(operator.or_, client.gather(parts))
    assert client.submit(volume, whole).result() == volume(alone)
    assert isinstance(volume(alone), fractions.Fraction)


def test_a_failure_comes_back_as_it_is(client):
    with pytest.raises(trisect.Error):
        client.submit(ball, -1, pure=False).result()
