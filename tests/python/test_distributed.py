"""Sweeps on a local cluster of processes. What Dask itself warns of is not ours."""

import os
import signal

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


def test_a_killed_worker_loses_nothing(client, pd_drive):
    here = gearlash.sweep(pd_drive, axes(), QUANTITIES)
    victim = next(iter(client.run(os.getpid).values()))
    killed_at = []

    def kill_after_the_first_piece(share):
        if not killed_at:
            os.kill(victim, signal.SIGKILL)
            killed_at.append(share)

    there = ours.sweep(pd_drive, axes(), QUANTITIES, client, most=1,
                       progress=kill_after_the_first_piece)
    assert killed_at == [1 / 6]  # five pieces were left, on both workers
    identical(here, there)


def test_a_tolerance_study_is_that_of_one_process(client, pd_drive, servo):
    varied = {"gearbox.backlash": gearlash.UniformBetween(1e-3, 3e-3),
              "load.inertia": gearlash.Normal(5e-3, 3e-4)}
    for drive, spread, samples in ((pd_drive, varied, 128), (
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


def test_a_graph_has_more_points_than_a_sweep_may_have(servo):
    grid = [gearlash.linear("servo.damping", 0.1, 0.5, 101),
            gearlash.linear("servo.backlash", 0.1, 0.5, 100),
            gearlash.linear("servo.friction_ratio", 0.1, 0.5, 1000),
            gearlash.linear("servo.inertia_ratio", 1, 2, 100)]
    with pytest.raises(gearlash.InvalidInput, match=r"points = 1\.01e\+09: must be at most 1e\+09"):
        gearlash.sweep(servo, grid, ["amplitude"])
    last = ours.graph(servo, grid, ["amplitude"], most=100_000_000)[-1]
    _, columns = last.compute(scheduler="synchronous")
    end = [gearlash.Axis(one.path, one.values[-1:]) for one in grid[:2]]
    here = gearlash.sweep(servo, [*end, *grid[2:]], ["amplitude"])["amplitude"].values.ravel()
    assert columns["amplitude"].size == 10_000_000
    assert np.array_equal(columns["amplitude"][-here.size:], here)


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
