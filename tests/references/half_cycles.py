"""The plastic half cycle of two masses, and its derivatives as central differences."""

import math

from mpmath import mp, mpf

from table import Draws, Family, Table


class Servo:
    """J_M + J_L = 1, K = 1, F_M + F_L = 2ζ, from exact numbers."""

    def __init__(self, damping, inertia_ratio, friction_ratio):
        z, r, f = mpf(damping), mpf(inertia_ratio), mpf(friction_ratio)
        self.damping = z
        self.motor_inertia = 1 / (1 + r)
        self.load_inertia = r / (1 + r)
        self.motor_friction = 2 * z * (1 - f)
        self.load_friction = 2 * z * f
        self.motor_rate = self.motor_friction / self.motor_inertia
        self.load_rate = self.load_friction / self.load_inertia
        self.split = mp.sqrt(abs(z * z - 1))

    def first_zero(self, x, v, a, b):
        """First zero of a x + b ẋ while engaged, by hyperbolic or circular functions."""
        z, w = self.damping, self.split
        value = a * x + b * v
        slope = a * v - b * (2 * z * v + x)
        if z == 1:
            time = -value / (slope + value)
            return time if time > 0 else None
        if z < 1:
            angle = mp.atan2(-value * w, slope + z * value)
            return (angle if angle > 0 else angle + mp.pi) / w
        slow = (slope + (z + w) * value) / (2 * w)
        quotient = -(value - slow) / slow
        return mp.log(quotient) / (2 * w) if quotient > 1 else None

    def engaged(self, x, v, time):
        z, w = self.damping, self.split
        decay = mp.exp(-z * time)
        if z < 1:
            c, s = mp.cos(w * time), mp.sin(w * time) / w
        elif z > 1:
            c, s = mp.cosh(w * time), mp.sinh(w * time) / w
        else:
            c, s = mpf(1), time
        return decay * (x * (c + z * s) + v * s), decay * (v * (c - z * s) - x * s)

    def parting(self, x, v):
        """When the mesh torque F_L v + J_L v̇ is 0, and the state there."""
        time = self.first_zero(
            x, v, -self.load_inertia,
            self.load_friction * self.motor_inertia - self.motor_friction * self.load_inertia,
        )
        return None if time is None else (time, *self.engaged(x, v, time))

    def growth_at_rest(self):
        """The load at rest at −1, the motor arriving at 1/F_M."""
        parting = self.parting(mpf(-1), self.motor_inertia / self.motor_friction)
        return mpf(0) if parting is None else abs(parting[1] + parting[2] / self.load_rate)

    def half_cycle(self, time):
        """After a flight that parts at speed 1: gap, place and speed of impact, time engaged, and
        speed of the next parting."""
        c, d = self.motor_rate, self.load_rate
        start = d - 2 * self.damping
        load_decay, motor_decay = mp.exp(-d * time), mp.exp(-c * time)
        # v_M = k e^{−ct} + p + q e^{−Dt}
        p = -(start + 1 / d) / self.motor_friction
        q = 1 / (d * self.motor_inertia * (c - d))
        k = 1 - p - q
        way = (1 - load_decay) / d
        motor_way = k * (1 - motor_decay) / c + p * time + q * way
        motor_speed = k * motor_decay + p + q * load_decay
        speed = self.motor_inertia * motor_speed + self.load_inertia * load_decay
        parting = self.parting(start + way, speed)
        engaged, growth = (None, mpf(0)) if parting is None else (parting[0], -parting[2])
        return way - motor_way, start + way, speed, engaged, growth

    def rough_flight_time(self):
        """Growth of a half cycle passes 1 once: by halving the range, to some 15 digits."""
        low, high = mpf(-60), mpf(60)
        for _ in range(60):
            middle = (low + high) / 2
            if self.half_cycle(mp.power(2, middle))[4] >= 1:
                high = middle
            else:
                low = middle
        return mp.power(2, high)

    def flight_time(self, near):
        """By the secant method on ln ρ."""
        before, time = near * (1 - mpf(10) ** -14), near
        value_before = mp.log(self.half_cycle(before)[4])
        for _ in range(60):
            value = mp.log(self.half_cycle(time)[4])
            if value == value_before:
                break
            step = value * (time - before) / (value - value_before)
            before, time, value_before = time, time - step, value
            if abs(step) < time * mpf(10) ** (20 - mp.dps):
                break
        return time

    def cycle(self, near):
        """Amplitude of unit backlash, period, multiplier."""
        time = self.flight_time(near)
        gap, position, speed, engaged, _ = self.half_cycle(time)
        extremes = [abs(self.load_rate - 2 * self.damping), abs(position)]
        turning = self.first_zero(position, speed, 0, 1)
        if turning is not None and turning < engaged:
            extremes.append(abs(self.engaged(position, speed, turning)[0]))
        # R(σ) = σ ρ(t), σ = 1/gap(t), of which a difference gives the slope.
        step = time * mpf(10) ** (-(mp.dps // 3))
        later, sooner = self.half_cycle(time + step), self.half_cycle(time - step)
        slope = (later[4] / later[0] - sooner[4] / sooner[0]) / (1 / later[0] - 1 / sooner[0])
        return max(extremes) / gap, 2 * (time + engaged), slope * slope


def rough_flight_time(*numbers):
    with mp.workdps(60):
        servo = Servo(*numbers)
        return servo.rough_flight_time() if servo.growth_at_rest() > 1 else None


def plastic_cycle(_, *numbers):
    near = rough_flight_time(*numbers)
    with mp.workdps(140):
        servo = Servo(*numbers)
        growth = servo.growth_at_rest()
        return [growth, *(servo.cycle(near) if near else [None] * 3)]


def drawn_over_decades(draws):
    """Damping over seven decades, or about 1; ratios over twelve; frictions next to 0 and to 1."""
    kind, side = draws.random(), draws.random()
    if kind < 0.7:
        damping = draws.log_uniform(1e-4, 1e3)
    elif kind < 0.9:
        damping = draws.uniform(0.0, 2.0)
    else:
        damping = 1.0 + draws.either_sign(1e-15, 1e-3) if kind < 0.95 else 1.0
    share = draws.uniform(0.0, 1.0) if side < 0.4 else draws.log_uniform(1e-12, 1.0)
    return damping, draws.log_uniform(1e-6, 1e6), share if side < 0.7 else 1.0 - share


def drawn_servo(draws):
    return draws.log_uniform(0.01, 3.0), draws.log_uniform(1e-3, 1e3), draws.uniform(0.01, 0.99)


# ---- derivatives ----------------------------------------------------------------------------------

LIGHT = mpf(10) ** -30  # a side of this share of the inertia is as good as massless


def derivatives(kind, damping, inertia_ratio, friction_ratio):
    """Growth at rest, amplitude, period and multiplier, and of each the derivatives by damping, by
    inertia ratio (by the load's share of the inertia where a side is massless) and by friction
    ratio."""
    massless = inertia_ratio in (0.0, math.inf)
    with mp.workdps(220 if massless else 110):
        ratio = mpf(inertia_ratio) if not massless else LIGHT if inertia_ratio == 0.0 else 1 / LIGHT
        here = [mpf(damping), ratio, mpf(friction_ratio)]
        near = rough_flight_time(*here)
        growth = Servo(*here).growth_at_rest()
        if not belongs(kind, growth):
            return None
        near = near and Servo(*here).flight_time(near)

        def values(numbers):
            servo = Servo(*numbers)
            return [servo.growth_at_rest(), *(servo.cycle(near) if near else [mp.nan] * 3)]

        slopes = []
        for i in range(3):
            step = here[i] * mpf(10) ** -22
            above, below = list(here), list(here)
            above[i] += step
            below[i] -= step
            rate = (1 + ratio) ** 2 if massless and i == 1 else 1
            slopes.append(
                [rate * (a - b) / (2 * step) for a, b in zip(values(above), values(below))]
            )
        return [x for number in zip(values(here), *slopes) for x in number]


def belongs(kind, growth):
    return {"hunting": growth > 1 + 1e-6, "critical": growth > 0.1, "massless": growth > 0.1,
            "massless-hunting": growth > 1 + 1e-6}.get(kind, True)


def drawn_at_growth(draws):
    """Friction ratio at which growth at rest is 1 and a little, or nothing where none is."""
    excess = draws.log_uniform(1e-10, 1e-1)
    while True:
        damping, ratio, low = drawn_servo(draws)
        high = 1e-4 if low < 0.5 else 1.0 - 1e-4  # where it hunts

        def too_much(friction):
            return Servo(damping, ratio, friction).growth_at_rest() > 1 + mpf(excess)

        with mp.workdps(40):
            if too_much(low) or not too_much(high):
                continue
            for _ in range(60):
                middle = 0.5 * (low + high)
                low, high = (low, middle) if too_much(middle) else (middle, high)
        return damping, ratio, low


def light_damping(draws):
    return (draws.log_uniform(1e-6, 1e-2), *drawn_servo(draws)[1:])


def critical_damping(draws):
    return (1.0 + draws.either_sign(1e-12, 1e-2), *drawn_servo(draws)[1:])


def massless_side(draws):
    damping, _, friction = drawn_servo(draws)
    return damping, draws.choice((0.0, math.inf)), friction


TABLES = [
    Table(
        "closed_form/plastic_cycles",
        "The plastic limit cycle: growth of a small disturbance of rest, amplitude over backlash,\n"
        "period and multiplier.",
        "damping inertia_ratio friction_ratio", "growth amplitude period multiplier",
        plastic_cycle,
        [
            Family("decades", 3500, drawn_over_decades),
            Family("ordinary", 1000, drawn_servo),
        ],
        seed=1831,
    ),
    Table(
        "question/plastic_slopes",
        "The plastic limit cycle and its derivatives, of which each is a central difference.\n"
        "Those by inertia_ratio are by the load's share of the inertia where a side is massless.",
        "damping inertia_ratio friction_ratio",
        " ".join(f"{value} {value}:damping {value}:inertia_ratio {value}:friction_ratio"
                 for value in ("growth", "amplitude", "period", "multiplier")),
        derivatives,
        [
            Family("any", 340, drawn_servo),
            Family("hunting", 670, drawn_servo),
            Family("boundary", 200, drawn_at_growth),
            Family("light", 100, light_damping),
            Family("critical", 100, critical_damping),
            Family("massless", 100, massless_side),
            Family("massless-hunting", 100, massless_side),
        ],
        seed=2101, digits=18, sample=6,
    ),
]
