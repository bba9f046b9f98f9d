"""Divided differences of exp, engaged motions and flights, from their definitions."""

from mpmath import mp, mpf

from table import Family, Table


def divided_difference(points):
    """exp[x₀ … x_n] of points in order, equal ones side by side, by Hermite's recursion."""
    if points[0] == points[-1]:
        return mp.exp(points[0]) / mp.factorial(len(points) - 1)
    return (divided_difference(points[1:]) - divided_difference(points[:-1])) / (
        points[-1] - points[0]
    )


def difference_of_exp(*points):
    """With the digits that quotients of near points lose."""
    ordered = sorted(mpf(x) for x in points)
    with mp.workdps(30):
        gaps = [b - a for a, b in zip(ordered, ordered[1:]) if b > a]
        lost = max([0, *(-int(mp.log10(gap)) for gap in gaps)])
        size = int(mp.log10(1 - ordered[0]))
    with mp.workdps(60 + (len(points) - 1) * (lost + 2 * size)):
        return divided_difference(ordered)


def flight_differences(_, x, y):
    x, y = mpf(x), mpf(y)
    return [
        difference_of_exp(*points)
        for points in (
            [-x], [0, -x], [0, 0, -x], [-x, -y], [0, -x, -y], [0, 0, -x, -y],
        )
    ]


def near(draws, x, low, high):
    return x * (1.0 + draws.either_sign(low, high))


def over_the_quadrant(draws):
    return draws.log_uniform(1e-12, 1e9), draws.log_uniform(1e-12, 1e9)


def of_order_one(draws):
    return draws.log_uniform(0.01, 10.0), draws.log_uniform(0.1, 10.0)


def nearly_equal(draws):
    x = draws.log_uniform(1e-12, 1e9)
    return x, near(draws, x, 1e-16, 0.1)


def about_the_series(draws):
    def one():
        return draws.uniform(0.0, 2.0) if draws.happens(0.5) else draws.uniform(0.9, 1.1)

    x = one()
    return x, near(draws, x, 1e-15, 0.1) if draws.happens(0.2) else one()


def before_exponents_vanish(draws):
    return draws.log_uniform(1e-8, 600.0), draws.log_uniform(1e-8, 600.0)


ENDS = [
    0.0, 5e-324, 1e-300, 1e-20, 1e-12, 1e-8, 1e-4, 0.1, 0.5, 1 - 2**-53, 1.0, 1 + 2**-52, 1.5, 3.0,
    36.0, 700.0, 708.0, 745.0, 800.0, 1e4, 1e9,
]


# ---- engaged motion -------------------------------------------------------------------------------


def engaged(damping, position, speed, time):
    """ẍ + 2ζẋ + x = 0 by its two rates, which may coincide."""
    with mp.workdps(120):
        z, x, v, t = (mpf(number) for number in (damping, position, speed, time))
        split = mp.sqrt(mp.mpc(z * z - 1))
        slow, fast = -z + split, -z - split
        if slow == fast:
            shared = t * mp.exp(slow * t)
        else:
            shared = (mp.exp(slow * t) - mp.exp(fast * t)) / (slow - fast)
        decay = mp.exp(slow * t)
        return [
            mp.re(decay * x + shared * (v - slow * x)),
            mp.re(decay * v + shared * (fast * v - x)),
        ]


def drawn_damping(draws):
    kind = draws.random()
    if kind < 0.1:
        return draws.choice((0.0, 1.0, 1000.0, 1e-12))
    if kind < 0.4:
        return abs(1.0 + draws.either_sign(1e-16, 1e-3))
    return draws.uniform(0.0, 2.0) if kind < 0.8 else draws.log_uniform(1.0, 1000.0)


def drawn_motion(draws):
    return (
        drawn_damping(draws), draws.uniform(-1.0, 1.0), draws.uniform(-1.0, 1.0),
        draws.log_uniform(1e-9, 100.0),
    )


BESIDE_CRITICAL = [
    1.0 + side * offset
    for offset in (1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13, 1e-15, 1e-16, 0.0)
    for side in (-1.0, 1.0)
]


def first_zero(damping, value, slope):
    """The first time > 0 at which x = 0, and Σ|terms of x there|/|ẋ|; nothing if there is none."""
    with mp.workdps(150 if abs(value) > 1e-100 else 700):
        z, x, v = mpf(damping), mpf(value), mpf(slope)
        if z < 1:
            w = mp.sqrt(1 - z * z)
            angle = mp.atan2(-x * w, v + z * x)
            if (x, v) == (0, 0):
                return None
            time = (angle if angle > 0 else angle + mp.pi) / w
        elif z == 1:
            if v + x == 0 or -x / (v + x) <= 0:
                return None
            time = -x / (v + x)
        else:
            w = mp.sqrt(z * z - 1)
            slow = (v + (z + w) * x) / (2 * w)  # x = slow e^{−(ζ−w)t} + fast e^{−(ζ+w)t}
            fast = x - slow
            if slow == 0 or -fast / slow <= 1:
                return None
            time = mp.log(-fast / slow) / (2 * w)
        of_value, of_slope = engaged(z, 1, 0, time), engaged(z, 0, 1, time)
        moved = abs(x * of_value[0]) + abs(v * of_slope[0])
        return [time, moved / abs(x * of_value[1] + v * of_slope[1])]


def drawn_zero(draws):
    damping = drawn_damping(draws)
    return (
        damping, draws.either_sign(1e-12, 1.0), draws.either_sign(1e-12, 1.0) * max(1.0, damping)
    )


ZERO_EDGES = [
    *((damping, 0.0, slope) for damping in (0.0, 0.5, 0.999) for slope in (1.0, -1.0)),
    (0.2, 1e-300, -1.0), (0.2, 1e-300, 1.0), (0.2, -1e-300, 1.0), (1.0, 1e-300, -1.0),
    (10.0, 1e-300, -1.0), (0.0, 1.0, 0.0), (0.0, 1.0, 1e-300), (1.0, 1.0, 1e-300),
    (1.0, 0.0, 1.0), (2.0, 0.0, -1.0), (0.2, 0.0, 0.0), (1.0, 0.0, 0.0), (5.0, 0.0, 0.0),
    # Along the fast direction of an overdamped servo there is no zero; a little steeper there is.
    *(
        (damping, 1.0, slope)
        for damping in (1.0, 1.0 + 1e-12, 1.5, 4.0, 1000.0)
        for fast in [damping + ((damping - 1.0) * (damping + 1.0)) ** 0.5]
        for slope in (-0.999 * fast, 0.0, 5.0, -1.001 * fast, -100.0 * fast)
    ),
    *((damping, *start) for damping in BESIDE_CRITICAL for start in ((1.0, -2.0), (-0.3, 10.0))),
]


# ---- flights --------------------------------------------------------------------------------------


def exponential(matrix):
    """Taylor's series of A/2^s, squared s times."""
    norm = max(sum(abs(entry) for entry in row) for row in matrix.tolist())
    squarings = max(0, int(mp.ceil(mp.log(4 * norm, 2)))) if norm > 0 else 0
    with mp.workdps(60 + squarings):
        scaled = matrix / mpf(2) ** squarings
        term = result = mp.eye(matrix.rows)
        for k in range(1, 60 + squarings):
            term = term * scaled / k
            result = result + term
            if mp.norm(term) < mpf(10) ** (-mp.dps):
                break
        for _ in range(squarings):
            result = result * result
        return result


def flight(kind, damping, inertia_ratio, friction_ratio, position, speed, gap_speed, time):
    """Of ẏ_L = v_L, v̇_L = −D v_L, ẏ_M = v_M, v̇_M = −c v_M − y_L/J_M; a clean parting begins where
    ü = 0."""
    with mp.workdps(80):
        r, z, f, t = (mpf(x) for x in (inertia_ratio, damping, friction_ratio, time))
        y, v, w = mpf(position), mpf(speed), mpf(gap_speed)
        motor_inertia = 1 / (1 + r)
        motor_rate = 2 * z * (1 - f) / motor_inertia
        load_rate = 2 * z * f * (1 + r) / r
        if kind == "clean":
            y = (load_rate - motor_rate) * motor_inertia * v
        flow = mp.matrix(4)
        flow[0, 1] = flow[2, 3] = t
        flow[1, 1] = -t * load_rate
        flow[3, 0] = -t / motor_inertia
        flow[3, 3] = -t * motor_rate
        end = exponential(flow) * mp.matrix([y, v, 0, v + w])
        return [end[0], end[1], end[2] - (end[0] - y), end[3] - end[1]]


def drawn_flight(draws):
    damping = draws.choice((0.0, 1.0)) if draws.happens(0.1) else draws.uniform(0.0, 2.0)
    ratio = draws.log_uniform(1e-6, 1e6)
    friction = draws.choice((0.0, 1.0)) if draws.happens(0.2) else draws.uniform(0.0, 1.0)
    if draws.happens(0.2):
        friction = ratio / (1.0 + ratio)  # D = c to rounding
    return (
        damping, ratio, friction, *(draws.uniform(-1.0, 1.0) for _ in range(3)),
        draws.log_uniform(1e-9, 50.0),
    )


def clean_flight(draws):
    servo = drawn_flight(draws)
    return (*servo[:3], 0.0, 1.0, 0.0, servo[6])


FROM_GAP = (-0.4, 0.8, 0.1)
NEARLY_EQUAL_RATES = [
    (0.3, ratio, min(1.0, ratio / (1.0 + ratio) * (1.0 + side * offset)), *FROM_GAP, time)
    for ratio in (1e-3, 0.3, 1.0, 5.0, 1e3)
    for offset in (0.0, 1e-16, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2)
    for side in (-1.0, 1.0)
    for time in (1e-3, 0.7, 3.0, 20.0)
]
VANISHING_RATES = [
    (*servo, *FROM_GAP, time)
    for share in (0.0, 1e-300, 1e-100, 1e-16, 1e-12, 1e-8, 1e-4)
    for time in (1e-6, 0.5, 10.0)
    for servo in ((0.3, 2.0, share), (0.3, 2.0, 1.0 - share), (share, 2.0, 0.4))
]
EXTREMES = [
    (damping, ratio, 0.3, *FROM_GAP, time)
    for ratio in (1e-9, 1e-6, 1e6, 1e9)
    for damping in (0.0, 0.1, 1.0, 1000.0)
    for time in (1e-9, 1e-3, 1.0)
]
LIGHT_LOADS = [
    (0.3, ratio, 0.4, *FROM_GAP, time)
    for ratio in (1e-2, 1e-4, 1e-6, 1e-9)
    for time in (1e-3, 0.1, 1.0, 3.0)
]

TABLES = [
    Table(
        "closed_form/divided_differences",
        "Divided differences of exp: -x; 0, -x; 0, 0, -x; -x, -y; 0, -x, -y; 0, 0, -x, -y.",
        "x y", "factor integral double_integral joint joint_integral joint_double_integral",
        flight_differences,
        [
            Family("end", listed=[(x, y) for x in ENDS for y in ENDS]),
            Family("quadrant", 1000, over_the_quadrant),
            Family("one", 1000, of_order_one),
            Family("equal", 800, nearly_equal),
            Family("series", 600, about_the_series),
            Family("exponents", 400, before_exponents_vanish),
        ],
        seed=1843,
    ),
    Table(
        "closed_form/engaged_motions",
        "Where x'' + 2 damping x' + x = 0 leads from position and speed in a time.",
        "damping position speed time", "end_position end_speed",
        lambda kind, *inputs: engaged(*inputs),
        [
            Family("critical", listed=[
                (damping, *start, time) for damping in BESIDE_CRITICAL
                for time in (1e-6, 0.1, 1.0, 7.0, 40.0) for start in ((1.0, -1.0), (0.25, 3.0))
            ]),
            Family("long", listed=[
                *((0.0, 1.0, 0.5, time) for time in (1e3, 1e5, 1e7)),
                (1000.0, 1.0, 0.0, 2000.0), (1000.0, 1.0, 0.0, 1e-4),
            ]),
            Family("drawn", 2000, drawn_motion),
        ],
        seed=271,
    ),
    Table(
        "closed_form/first_zeros",
        "The first zero after time 0 of x'' + 2 damping x' + x = 0 from (value, slope), and how far\n"
        "it moves where every term of x moves by its own size.",
        "damping value slope", "zero condition",
        lambda kind, *inputs: first_zero(*inputs) or [mp.inf, 0],
        [Family("edge", listed=ZERO_EDGES), Family("drawn", 1000, drawn_zero)],
        seed=273,
    ),
    Table(
        "closed_form/gap_flights",
        "Two masses that part: load position and speed, displacement and speed of the gap after a\n"
        "time. A clean parting is at the load position at which the gap does not accelerate.",
        "damping inertia_ratio friction_ratio load_position load_speed gap_speed time",
        "end_position end_speed gap_displacement end_gap_speed",
        flight,
        [
            Family("equal", listed=NEARLY_EQUAL_RATES),
            Family("vanishing", listed=VANISHING_RATES),
            Family("extreme", listed=EXTREMES),
            Family("light", listed=LIGHT_LOADS),
            Family("drawn", 900, drawn_flight),
            Family("clean", 500, clean_flight),
        ],
        seed=314,
    ),
]
