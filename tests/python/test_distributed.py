"""Sweeps on a local cluster of processes. What Dask itself warns of is not ours."""

import os
import signal
import threading
import time

import numpy as np
import pytest
import xarray

import gearlash
from gearlash import distributed as ours

pytestmark = pytest.mark.filterwarnings("ignore")
QUANTITIES = ("amplitude", "motor_amplitude", "frequency")


@pytest.fixture(scope="module")
def cluster():
    from distributed import LocalCluster

    with LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None,
                      scheduler_port=0, silence_logs=50) as made:
        yield made


@pytest.fixture
def client(cluster):
    from distributed import Client

    with Client(cluster) as made:
        yield made


def axes():
    return {"controller.proportional": "5:40:6:log", "gearbox.backlash": "0.5 mrad:4 mrad:5"}


def identical(one, other):
    assert one.dims == other.dims
    for name in one.variables:
        assert np.array_equal(one[name].values, other[name].values,
                              equal_nan=one[name].dtype.kind == "f"), name


def test_data_are_those_of_one_process(client, pd_drive):
    here = gearlash.sweep(pd_drive, axes(), QUANTITIES)
    there = gearlash.sweep(pd_drive, axes(), QUANTITIES, client=client)
    identical(here, there)
    identical(here, ours.sweep(pd_drive, axes(), QUANTITIES, client, most=1))


def test_a_killed_worker_loses_nothing(cluster, client, pd_drive):
    here = gearlash.sweep(pd_drive, axes(), QUANTITIES)
    victims = list(client.run(os.getpid).values())
    killed = []

    def kill_one():
        # As soon as the first piece is done, others are on their way.
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline and not client.scheduler_info()["workers"]:
            time.sleep(0.01)
        time.sleep(0.15)
        os.kill(victims[0], signal.SIGKILL)
        killed.append(victims[0])

    killer = threading.Thread(target=kill_one)
    killer.start()
    there = ours.sweep(pd_drive, axes(), QUANTITIES, client, most=1)
    killer.join()
    assert killed
    identical(here, there)


def test_one_axis_is_divided_where_a_new_run_begins(client, pd_drive):
    axis = {"controller.proportional": "5:40:70:log"}
    here = gearlash.sweep(pd_drive, axis, QUANTITIES)
    shares = []
    there = gearlash.sweep(pd_drive, axis, QUANTITIES, client=client, progress=shares.append)
    assert shares == [1 / 3, 2 / 3, 1.0]
    identical(here, there)


def test_a_stop_leaves_nothing_behind(client, pd_drive):
    with pytest.raises(RuntimeError, match="stopped"):
        ours.sweep(pd_drive, axes(), QUANTITIES, client, most=1, progress=lambda share: False)


def test_faults_are_raised_before_anything_is_sent(client, pd_drive):
    with pytest.raises(gearlash.InvalidInput, match="amplitudo"):
        gearlash.sweep(pd_drive, axes(), ["amplitudo"], client=client)
    with pytest.raises(gearlash.InvalidInput, match="backlash"):
        gearlash.sweep(pd_drive, {"gearbox.backlash": [-1.0, 1.0]}, client=client)


def test_a_tolerance_study_is_that_of_one_process(client, pd_drive, servo):
    varied = {"gearbox.backlash": gearlash.UniformBetween(1e-3, 3e-3),
              "load.inertia": gearlash.Normal(5e-3, 3e-4)}
    for drive, spread, samples in ((pd_drive, varied, 64), (
            servo, {"servo.damping": gearlash.UniformBetween(0.7, 1.0)}, 2048)):
        here = gearlash.tolerance(drive, spread, samples=samples)
        assert gearlash.tolerance(drive, spread, samples=samples, client=client) == here
    with pytest.raises(gearlash.InvalidInput):
        gearlash.tolerance(pd_drive, {"no.such": gearlash.UniformBetween(1, 2)}, client=client)


def test_a_graph_of_its_own_pieces(pd_drive):
    import dask

    here = gearlash.sweep(pd_drive, axes(), QUANTITIES)
    parts = dask.compute(*ours.graph(pd_drive, axes(), QUANTITIES, most=5),
                         scheduler="synchronous")
    amplitudes = np.concatenate([columns["amplitude"] for _, columns in parts])
    assert np.array_equal(amplitudes.reshape(6, 5), here["amplitude"].values, equal_nan=True)


def test_results_go_to_netcdf_and_zarr(tmp_path, servo):
    data = gearlash.sweep(servo, {"servo.damping": "0.1:0.9:9", "servo.friction_ratio": [0.1, 0.2]})
    data.to_netcdf(tmp_path / "data.nc")
    data.to_zarr(tmp_path / "data.zarr")
    with xarray.open_dataset(tmp_path / "data.nc") as back:
        identical(data, back.load())
    with xarray.open_zarr(tmp_path / "data.zarr") as back:
        identical(data, back.load())


@pytest.mark.parametrize("most", [1, 2, 5, 7, 30, 10_000])
def test_pieces_cover_the_grid_in_order(most):
    grid = [gearlash.Axis("a", (1.0, 2.0, 3.0)), gearlash.Axis("b", tuple(range(5))),
            gearlash.Axis("c", (0.5, 1.5))]
    points = [(a, b, c) for piece in ours.pieces(grid, most)
              for a in piece[0].values for b in piece[1].values for c in piece[2].values]
    assert points == [(a, b, c) for a in grid[0].values for b in grid[1].values
                      for c in grid[2].values]
    assert all(len(piece[2].values) == 2 for piece in ours.pieces(grid, most))
