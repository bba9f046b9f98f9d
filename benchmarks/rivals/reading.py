"""Amplitude and period of a limit cycle, read from samples of a motion."""
import numpy as np

PERIODS = 5  # read from this many periods at the end of the motion


def interpolated(start, end, speed_start, speed_end, width, part):
    """Cubic Hermite polynomial through two samples, at a part (0 to 1) of the way."""
    rest = 1 - part
    return (rest**2 * ((1 + 2 * part) * start + part * width * speed_start)
            + part**2 * ((1 + 2 * rest) * end - rest * width * speed_end))


def turning_points(time, position, speed):
    """Positions where the speed changes sign between two samples, also at one instant (impact)."""
    before = np.nonzero(speed[:-1] * speed[1:] < 0)[0]
    after = before + 1
    part = speed[before] / (speed[before] - speed[after])
    return interpolated(position[before], position[after], speed[before], speed[after],
                        time[after] - time[before], part)


def upward_crossings(time, position, speed):
    """Times at which the position crosses 0 upwards."""
    before = np.nonzero((position[:-1] < 0) & (position[1:] >= 0))[0]
    after = before + 1
    width = time[after] - time[before]
    part = position[before] / (position[before] - position[after])
    for _ in range(5):  # secant steps with the polynomial's mean slope
        value = interpolated(position[before], position[after], speed[before], speed[after],
                             width, part)
        part -= value / (position[after] - position[before])
    return time[before] + part * width


def amplitude_and_period(time, position, speed):
    """Means over the last PERIODS periods; an impact has two samples at one instant."""
    crossings = upward_crossings(time, position, speed)[-PERIODS - 1:]
    sizes = []
    for start, end in zip(crossings[:-1], crossings[1:]):
        one = (time >= start) & (time <= end)
        turns = turning_points(time[one], position[one], speed[one])
        sizes.append((turns.max() - turns.min()) / 2)
    return np.mean(sizes), (crossings[-1] - crossings[0]) / PERIODS
