"""A PID drive that hunts by stiction, followed by Taylor steps of one length."""

from mpmath import mp, mpf

from table import Family, Table

MOTOR, MOTOR_SPEED, LOAD, LOAD_SPEED, INTEGRAL = range(5)
ORDER, LENGTH = 34, mpf("0.125")


class StickingDrive:
    """Friction on the motor, sensor of position on the load and of speed on the motor, plastic
    faces. It begins pressed against the forward face, at rest, the error at its largest."""

    def __init__(self, motor_inertia, load_inertia, motor_friction, load_friction, sliding,
                 breakaway, backlash, *gains):
        self.motor_inertia, self.load_inertia = mpf(motor_inertia), mpf(load_inertia)
        self.motor_friction, self.load_friction = mpf(motor_friction), mpf(load_friction)
        self.sliding, self.breakaway = mpf(sliding), mpf(breakaway)
        self.half_gap = mpf(backlash) / 2
        self.gains = [mpf(gain) for gain in gains]
        self.x = [mpf("0.5") + self.half_gap, mpf(0), mpf("0.5"), mpf(0), mpf(0)]
        self.time, self.face, self.way = mpf(0), 1, 0
        self.fired = None
        self.highs, self.lows = [], []  # times and places at which the load turns or comes to rest

    def torque(self, x):
        proportional, integral, derivative = self.gains
        return integral * x[INTEGRAL] - proportional * x[LOAD] - derivative * x[MOTOR_SPEED]

    def slope(self, x, is_first):
        """Of a term of the series; what is constant counts in the first alone."""
        together = self.face != 0
        inertia = self.motor_inertia + (self.load_inertia if together else 0)
        friction = self.motor_friction + (self.load_friction if together else 0)
        of_motor = mpf(0)
        if self.way:
            constant = self.way * self.sliding if is_first else 0
            of_motor = (self.torque(x) - friction * x[MOTOR_SPEED] - constant) / inertia
        of_load = -self.load_friction * x[LOAD_SPEED] / self.load_inertia
        return [x[MOTOR_SPEED], of_motor, x[LOAD_SPEED], of_motor if together else of_load, -x[LOAD]]

    def guards(self):
        """What must not fall below 0."""
        def parts(x):
            return self.face * (
                self.load_inertia * self.slope(x, True)[LOAD_SPEED]
                + self.load_friction * x[LOAD_SPEED])

        if self.face == 0:
            yield "forward", lambda x: self.half_gap - (x[MOTOR] - x[LOAD])
            yield "backward", lambda x: self.half_gap + (x[MOTOR] - x[LOAD])
        if self.way:
            yield "stops", lambda x: self.way * x[MOTOR_SPEED]
            if self.face:
                yield "parts", parts
        else:
            yield "breaks forward", lambda x: self.breakaway - self.torque(x)
            yield "breaks backward", lambda x: self.breakaway + self.torque(x)

    def step(self):
        terms = [self.x]
        for k in range(1, ORDER + 1):
            terms.append([number * LENGTH / k for number in self.slope(terms[-1], k == 1)])

        def value(share):
            return [mp.polyval([term[i] for term in terms[::-1]], share) for i in range(5)]

        share, fires = mpf(1), None
        for name, guard in list(self.guards()):
            if guard(value(share)) >= 0 or (name == self.fired and guard(self.x) <= 0):
                continue
            share, fires = first_negative(lambda s, g=guard: g(value(s)), share), name
        end = value(share)
        if self.x[LOAD_SPEED] * end[LOAD_SPEED] < 0:
            sign = mp.sign(self.x[LOAD_SPEED])
            turn = first_negative(lambda s: sign * value(s)[LOAD_SPEED], share)
            self.note(self.time + turn * LENGTH, value(turn)[LOAD], sign)
        self.x, self.time, self.fired = end, self.time + share * LENGTH, fires
        if fires:
            self.fire(fires)

    def note(self, time, place, sign):
        (self.highs if sign > 0 else self.lows).append((time, place))

    def fire(self, guard):
        x = self.x
        if guard in ("forward", "backward"):
            before = x[LOAD_SPEED]
            common = (self.motor_inertia * x[MOTOR_SPEED] + self.load_inertia * before) / (
                self.motor_inertia + self.load_inertia)
            x[MOTOR_SPEED] = x[LOAD_SPEED] = common
            if before * common < 0:
                self.note(self.time, x[LOAD], before)
            self.face, self.way = (1 if guard == "forward" else -1), int(mp.sign(common))
        elif guard == "stops":
            if self.face and x[LOAD_SPEED] != 0:
                self.note(self.time, x[LOAD], self.way)
            x[MOTOR_SPEED] = mpf(0)
            if self.face:
                x[LOAD_SPEED] = mpf(0)
            self.way = 0
        elif guard == "parts":
            self.face = 0
        else:
            self.way = 1 if guard == "breaks forward" else -1
            self.face = self.face if self.way == self.face else 0


def first_negative(function, high):
    """Between 0 and `high`, at which it is negative: regula falsi, with a halving now and then."""
    low, at_low, at_high = mpf(0), function(mpf(0)), function(high)
    for i in range(200):
        if high - low < mpf(10) ** (5 - mp.dps):
            break
        middle = (low + high) / 2
        if i % 3 != 2 and at_low != at_high:
            chord = (low * at_high - high * at_low) / (at_high - at_low)
            middle = chord if low < chord < high else middle
        here = function(middle)
        if here < 0:
            high, at_high = middle, here
        else:
            low, at_low = middle, here
    return high


def hunting(_, *numbers):
    """Amplitude and period after forty periods of about the last number."""
    with mp.workdps(30):
        *numbers, length = numbers
        drive = StickingDrive(*numbers)
        end = 40 * mpf(length)
        while drive.time < end:
            drive.step()

        def extreme(turns, low, high, sign):
            return max((turn for turn in turns if low <= turn[0] < high), key=lambda t: sign * t[1])

        high = extreme(drive.highs, end - length * 1.1, end, 1)
        low = extreme(drive.lows, end - length * 1.1, end, -1)
        before = extreme(drive.highs, high[0] - length * 1.25, high[0] - length * 0.75, 1)
        return [(high[1] - low[1]) / 2, high[0] - before[0]]


TABLES = [
    Table(
        "general/stiction_hunting",
        "A PID drive, derivative of the motor's speed, that hunts by stiction: amplitude and period.",
        "motor_inertia load_inertia motor_friction load_friction sliding breakaway backlash"
        " proportional integral derivative guessed_period",
        "amplitude period",
        hunting,
        [Family("known", listed=[
            (1.0, 0.25, 0.25, 0.125, 0.25, 0.375, 0.03125, 4.0, 1.0, 2.0, 32.25)])],
        seed=1, sample=0,
    ),
]
