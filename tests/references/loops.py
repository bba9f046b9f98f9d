"""Norms of loops, gains of describing functions, and turning points of flights."""

from mpmath import mp, mpf

from exponentials import exponential
from half_cycles import Servo
from table import Family, Table

# ---- ceilings -------------------------------------------------------------------------------------


def product(a, b):
    result = [mpf(0)] * (len(a) + len(b) - 1)
    for i, x in enumerate(a):
        for k, y in enumerate(b):
            result[i + k] += x * y
    return result


def total(*polynomials):
    return [
        mp.fsum(p[i] for p in polynomials if i < len(p))
        for i in range(max(len(p) for p in polynomials))
    ]


def scaled(factor, polynomial):
    return [factor * x for x in polynomial]


def norm(numerator, denominator):
    """|G(∞)| + ∫|g| by residues, of simple poles that decay; polynomials by ascending powers."""
    order = len(denominator) - 1
    at_once = numerator[order] / denominator[order] if len(numerator) > order else mpf(0)
    rest = total(numerator, scaled(-at_once, denominator))[:order]
    poles = mp.polyroots(denominator[::-1], maxsteps=200, extraprec=200)
    slope = [k * x for k, x in enumerate(denominator)][1:]
    residues = [mp.polyval(rest[::-1], pole) / mp.polyval(slope[::-1], pole) for pole in poles]

    def impulse(time):
        return mp.re(mp.fsum(r * mp.exp(p * time) for p, r in zip(poles, residues)))

    def integral(time):
        return mp.re(mp.fsum(r / p * mp.exp(p * time) for p, r in zip(poles, residues)))

    fastest = max(abs(pole) for pole in poles)
    slowest = min(-mp.re(pole) for pole in poles)
    changes = sign_changes(poles, residues, 0.05 / float(fastest), 30.0 / float(slowest))
    ends = [mpf(0)] + [refined(impulse, low, high) for low, high in changes]
    values = [integral(time) for time in ends] + [mpf(0)]
    return abs(at_once) + mp.fsum(abs(b - a) for a, b in zip(values, values[1:]))


def sign_changes(poles, residues, step, end):
    """Between looks in doubles."""
    poles, residues = [complex(p) for p in poles], [complex(r) for r in residues]
    turns = [complex(mp.exp(p * step)) for p in poles]
    found, before, time = [], sum(residues).real, 0.0
    while time < end:
        residues = [r * turn for r, turn in zip(residues, turns)]
        now = sum(residues).real
        if now * before < 0.0:
            found.append((time, time + step))
        before, time = now, time + step
    return found


def refined(function, low, high):
    return mp.findroot(function, (mpf(low), mpf(high)), solver="anderson", tol=mpf("1e-50"),
                       verify=False)


def law(kind, numbers):
    """Effort = −(position y + speed v)/denominator."""
    a, b, c, d = (mpf(x) for x in numbers)
    if kind == "pid":  # proportional, derivative, integral, filter
        return total(product([c, a], [1, d]), [0, 0, b]), [mpf(0)], product([0, 1], [1, d])
    if kind == "cascade":  # position, speed, integral of speed
        return scaled(a, [c, b]), [c, b], [mpf(0), mpf(1)]
    return scaled(a, [1, 1 / b]), [mpf(0)], [mpf(1), 1 / c]  # lead-lag: gain, zero, pole


def gain_margin(control, plant):
    """1/|L| next to 1 as a ratio where L = control/plant is real and negative, and the frequency."""

    def part(polynomial, first):
        """Real or imaginary part at s = jω, by powers of ω²; the latter divided by ω."""
        return [x if k % 2 == 0 else -x for k, x in enumerate(polynomial[first::2])] or [mpf(0)]

    real = total(
        product(part(control, 1), part(plant, 0)),
        scaled(-1, product(part(control, 0), part(plant, 1))),
    )
    while real[-1] == 0:
        real.pop()
    squares = mp.polyroots(real[::-1], maxsteps=200, extraprec=400) if len(real) > 1 else []
    frequencies = [mp.sqrt(mp.re(x)) for x in squares if mp.im(x) == 0 and mp.re(x) > 0]
    found = []
    for w in frequencies + ([mpf(0)] if plant[0] != 0 else []):
        value = mp.re(mp.polyval(control[::-1], 1j * w) / mp.polyval(plant[::-1], 1j * w))
        if value < 0:
            found.append((abs(mp.log(-value)), -1 / value, w))
    return list(min(found)[1:]) if found else [None, None]


def ceilings(kind, motor_inertia, motor_viscous, load_inertia, load_viscous, of_load, speed_of_load,
             winding, back_emf, stiffness, *numbers):
    """Of the load and of the motor from a gap of unit half width, and whether the loop decays; and
    its gain margin."""
    with mp.workdps(60):
        position, speed, denominator = law(kind, numbers)
        common = product([1, mpf(winding)] if winding else [mpf(1)], denominator)
        motor = total(
            product([0, mpf(motor_viscous), mpf(motor_inertia)], common),
            scaled(mpf(back_emf), product([0, 1], denominator)),
        )
        load = product([0, mpf(load_viscous), mpf(load_inertia)], common)
        of_speed = product([0, 1], speed)
        opened = total(
            motor, scaled(1 - mpf(of_load), position), scaled(1 - mpf(speed_of_load), of_speed)
        )
        closed = total(motor, load, scaled(mpf(stiffness), common), position, of_speed)
        while closed[-1] == 0:
            closed.pop()
        poles = mp.polyroots(closed[::-1], maxsteps=200, extraprec=200)
        fastest, slowest = max(abs(p) for p in poles), min(-mp.re(p) for p in poles)
        if slowest <= 0:
            return [0, None, None, None, None]
        if fastest > 3000 * slowest:
            return None
        load_norm = norm(scaled(-1, opened), closed)
        control = total(position, of_speed)
        return [1, load_norm, norm(total(closed, scaled(-1, opened)), closed),
                *gain_margin(control, total(closed, scaled(-1, control)))]


def drawn_loop(kind):
    def draw(draws):
        plant = [
            draws.log_uniform(0.1, 2.0), draws.log_uniform(0.01, 0.5), draws.log_uniform(0.1, 2.0),
            draws.log_uniform(0.01, 0.5), draws.choice((0.0, 1.0)), draws.choice((0.0, 1.0)),
        ]
        has_winding = draws.happens(0.4)
        plant += [draws.log_uniform(0.01, 0.5), draws.log_uniform(0.01, 0.5)] if has_winding else [0.0, 0.0]
        plant.append(draws.uniform(-0.2, 0.5) if draws.happens(0.3) else 0.0)
        gain, derivative = draws.log_uniform(0.3, 3.0), draws.log_uniform(0.2, 2.0)
        integral, lag = draws.log_uniform(0.02, 0.3), draws.log_uniform(0.02, 0.3)
        zero = draws.log_uniform(0.3, 1.0)
        law_of = {
            "pid": (gain, derivative, integral, lag),
            "cascade": (gain, derivative, integral, 0.0),
            "lead-lag": (gain, zero, zero * draws.log_uniform(3.0, 30.0), 0.0),
        }
        return (*plant, *law_of[kind])

    return draw


# ---- describing functions -------------------------------------------------------------------------


def play(amplitude):
    """Of the gap 2 held by friction."""
    ratio = 1 / mpf(amplitude)
    r = 1 - 2 * ratio
    return (mp.pi / 2 + mp.asin(r) + r * mp.sqrt(1 - r * r)) / mp.pi, -4 * ratio * (1 - ratio) / mp.pi


def gains(kind, number):
    """The textbooks' forms: held by friction, saturation and dead zone of unit corner at an
    amplitude; a coasting load, half of whose gap is a share of the amplitude."""
    with mp.workdps(80):
        if kind == "coasting":
            angle = mpf(2)
            for _ in range(300):  # Newton's method, which begins linearly at a triple root
                angle -= (angle - mp.sin(angle) - 2 * mpf(number)) / (1 - mp.cos(angle))
            sine, cosine = mp.sin(angle), mp.cos(angle)
            return [1 - (angle - 2 * sine + sine * cosine) / mp.pi, -((1 - cosine) ** 2) / mp.pi,
                    None, None]
        ratio = 1 / mpf(number)
        share = (mp.asin(ratio) + ratio * mp.sqrt(1 - ratio * ratio)) * 2 / mp.pi
        return [*play(number), share, 1 - share]


def type_one_cycle(_, gain, amplitude, frequency):
    """1 + N G = 0 next to a guess, of G = gain/(s (s + 1)) and the gap 2 held by friction."""
    with mp.workdps(60):

        def mismatch(a, w):
            real, imaginary = play(a)
            return -w * w + gain * real, w + gain * imaginary

        return list(mp.findroot(mismatch, (mpf(amplitude), mpf(frequency)), tol=mpf("1e-100")))


# ---- turning points of flights --------------------------------------------------------------------


class Flight:
    """A gap that is u = 0 at first, by the equations of the two masses: sums of exponentials to
    find where it turns, the matrix exponential for how far it has come."""

    def __init__(self, damping, inertia_ratio, friction_ratio, position, speed, gap_speed):
        self.servo = Servo(damping, inertia_ratio, friction_ratio)
        self.y, self.v, self.w = mpf(position), mpf(speed), mpf(gap_speed)

    def gap_speed(self, time):
        s, y, v = self.servo, self.y, self.v
        c, d = s.motor_rate, s.load_rate
        constant = -(y + v / d) / s.motor_friction
        of_load = v / d / (s.motor_friction - s.motor_inertia * d)
        slow = mp.exp(-d * time)
        return constant + (of_load - v) * slow + (v + self.w - constant - of_load) * mp.exp(-c * time)

    def displacement(self, time):
        s = self.servo
        flow = mp.matrix(4)
        flow[0, 1] = flow[2, 3] = time
        flow[1, 1] = -time * s.load_rate
        flow[3, 0] = -time / s.motor_inertia
        flow[3, 3] = -time * s.motor_rate
        end = exponential(flow) * mp.matrix([self.y, self.v, 0, self.v + self.w])
        return end[2] - (end[0] - self.y)


def turning_points(_, *numbers):
    """Times and displacements of the first two turning points up to a time of 50."""
    with mp.workdps(50):
        flight = Flight(*numbers)
        found, direction, last, time = [], flight.w, mpf(0), mpf("1e-8")
        while time < 50 and len(found) < 4:
            speed = flight.gap_speed(time)
            if speed * direction < 0:
                turning = refined(flight.gap_speed, last, time)
                found += [turning, flight.displacement(turning)]
                direction = speed
            last, time = time, time * mpf("1.05")
        return (found + [None] * 4)[:4]


def drawn_flight(draws):
    """Speeds from far below to far above the gap's; now and then rates that nearly coincide, or a
    pull of the loop that nearly balances friction."""
    damping, ratio = draws.log_uniform(0.01, 2.0), draws.log_uniform(0.01, 100.0)
    friction = draws.uniform(0.01, 0.99)
    if draws.happens(0.2):
        friction = min(1.0, ratio / (1.0 + ratio) * (1.0 + draws.either_sign(1e-9, 1e-3)))
    speed, gap_speed = draws.either_sign(1e-3, 1e3), draws.either_sign(1e-4, 1.0)
    position = draws.uniform(-1.0, 1.0)
    if draws.happens(0.2):
        rates = 2.0 * damping * (friction * (1.0 + ratio) / ratio - (1.0 - friction) * (1.0 + ratio))
        position = rates / (1.0 + ratio) * speed * (1.0 + draws.either_sign(1e-9, 1e-1))
    return damping, ratio, friction, position, speed, gap_speed


TABLES = [
    Table(
        "question/ceilings",
        "How far load and motor go from each unit of half a gap, |G(oo)| + integral of |g|, of loops\n"
        "that decay (1) or do not (0); the gain margin of the former and its frequency, rad/s. The\n"
        "numbers of the law: proportional, derivative, integral, filter; position, speed, integral of\n"
        "speed; gain, zero, pole of a lead-lag element.",
        "motor_inertia motor_viscous load_inertia load_viscous position_of_load speed_of_load"
        " winding back_emf stiffness a b c d",
        "decays load motor margin frequency",
        ceilings,
        [Family(kind, 20, drawn_loop(kind)) for kind in ("pid", "cascade", "lead-lag")],
        seed=19601123, sample=3,
    ),
    Table(
        "question/describing_gains",
        "Describing functions in the textbooks' forms: real and imaginary part of backlash, and at\n"
        "amplitudes also saturation and dead zone.",
        "number", "real imaginary saturation dead_zone",
        gains,
        [
            Family("held", listed=[(1.0 + excess,) for excess in (
                2**-40, 2**-20, 2**-8, 0.125, 0.75, 1.25, 8.0, 2**20, 2**40)]),
            Family("coasting", listed=[
                (ratio,) for ratio in (2**-40, 2**-20, 2**-8, 0.1, 0.5, 1.0, 1.5, 1.5625)]),
        ],
        seed=1,
    ),
    Table(
        "question/type_one_cycles",
        "Predicted cycles of gain/(s (s + 1)) behind a gap of 2 that friction holds.",
        "gain guessed_amplitude guessed_frequency", "amplitude frequency",
        type_one_cycle,
        [Family("known", listed=[(5.0, 1.0557, 0.318), (5.0, 2.0206, 1.591)])],
        seed=1,
    ),
    Table(
        "closed_form/turning_points",
        "Flights from the middle of a gap, and the times and displacements at which it turns.",
        "damping inertia_ratio friction_ratio load_position load_speed gap_speed",
        "first_time first_travel second_time second_travel",
        turning_points,
        [
            Family("reported", listed=[(0.12038, 0.62877, 0.34696, 0.588, 164.38, 0.0030)]),
            Family("drawn", 1000, drawn_flight),
        ],
        seed=1961,
    ),
]
