"""Limit cycles with bounces, followed event by event, and their derivatives as differences."""

from mpmath import mp, mpf

from half_cycles import Servo
from table import Family, Table


class Bouncing(Servo):
    def __init__(self, damping, inertia_ratio, friction_ratio, restitution, backlash):
        super().__init__(damping, inertia_ratio, friction_ratio)
        self.restitution = mpf(restitution)
        self.half_gap = mpf(backlash) / 2

    def flight(self, state, time):
        """J_M v̇ + F_M v + y = 0 by undetermined coefficients: y, v, u, u̇."""
        y, v, u, w = state
        c, d = self.motor_rate, self.load_rate
        slow, fast = mp.exp(-d * time), mp.exp(-c * time)
        constant = -(y + v / d) / self.motor_friction
        of_load = v / d / (self.motor_friction - self.motor_inertia * d)
        free = v + w - constant - of_load
        way = (1 - slow) / d
        motor_way = constant * time + of_load * way + free * (1 - fast) / c
        speed = v * slow
        return (y + v * way, speed, u + motor_way - v * way,
                constant + of_load * slow + free * fast - speed)

    def first_face(self, state):
        """When a flight meets a face, to ten digits."""
        y, v, u, w = state
        step = mpf("0.01")
        if w != 0:  # after a low bounce it is back soon
            acceleration = -self.motor_rate * (v + w) - y / self.motor_inertia + self.load_rate * v
            back = -2 * w / acceleration
            step = min(step, back / 8) if back > 0 else step
        low, high = mpf(0), step
        while abs(self.flight(state, high)[2]) < self.half_gap:
            low, high = high, high + step
        for _ in range(36):
            middle = (low + high) / 2
            if abs(self.flight(state, middle)[2]) < self.half_gap:
                low = middle
            else:
                high = middle
        return high

    def fly(self, state, near):
        """By Newton's method; the face is that on whose side the flight is then."""
        time = near
        face = self.half_gap if self.flight(state, time)[2] > 0 else -self.half_gap
        for _ in range(12):
            there = self.flight(state, time)
            change = (face - there[2]) / there[3]
            time += change
            if abs(change) < time * mpf(10) ** (20 - mp.dps):
                break
        there = self.flight(state, time)
        return time, (there[0], there[1], face, there[3])

    def rebound(self, state):
        y, v, u, w = state
        return y, v + self.motor_inertia * (1 + self.restitution) * w, u, -self.restitution * w

    def engage(self, state):
        """The faces move as one until the mesh torque is 0: when, in which state, by which places."""
        y, v = state[0], state[1] + self.motor_inertia * state[3]
        time, end, speed = self.parting(y, v)
        turning = self.first_zero(y, v, 0, 1)
        turns = turning is not None and turning < time
        places = [end, self.engaged(y, v, turning)[0]] if turns else [end]
        return time, (end, speed, state[2], mpf(0)), places

    def period(self, arrival, length, times):
        """From the arrival (y, P, u̇) at the forward face to the one that ends a period of about
        `length`: that arrival, the period, the amplitude. Bounces are followed until they are 1e-20
        as fast as at first. Flights last about `times`, a list that is filled where it is empty."""
        state = (arrival[0], arrival[1] - self.motor_inertia * arrival[2], self.half_gap, arrival[2])
        is_new = not times
        places, elapsed, fastest, flights = [state[0]], mpf(0), mpf(0), 0
        while True:
            state = self.rebound(state)
            fastest = max(fastest, abs(state[3]))
            if abs(state[3]) <= fastest * mpf(10) ** -20:
                time, state, met = self.engage(state)
                elapsed += time
                places += met
            if is_new:
                times.append(self.first_face(state))
            time, arrived = self.fly(state, times[flights])
            flights += 1
            elapsed += time
            places.append(arrived[0])
            if arrived[2] != state[2]:
                fastest = mpf(0)
            state = arrived
            if state[2] > 0 and elapsed > length * (1 - mpf("1e-5")):
                break
        end = mp.matrix([state[0], state[1] + self.motor_inertia * state[3], state[3]])
        return end, elapsed, (max(places) - min(places)) / 2


def slope_of_map(servo, arrival, length, times):
    step = mpf(10) ** -22 * servo.half_gap
    slope = mp.matrix(3)
    for column in range(3):
        above, below = arrival.copy(), arrival.copy()
        above[column] += step
        below[column] -= step
        slope[:, column] = (
            servo.period(above, length, times)[0] - servo.period(below, length, times)[0]
        ) / (2 * step)
    return slope


def cycle(servo, arrival, length, times, slope=None):
    """The cycle next to an arrival, by Newton's method, and its slope."""
    for _ in range(12):
        mismatch = servo.period(arrival, length, times)[0] - arrival
        if slope is None or mp.norm(mismatch) > mpf("1e-12") * servo.half_gap:
            slope = slope_of_map(servo, arrival, length, times)
        arrival = arrival + mp.lu_solve(mp.eye(3) - slope, mismatch)
        if mp.norm(mismatch) < mpf("1e-26") * servo.half_gap:
            break
    _, period, amplitude = servo.period(arrival, length, times)
    slope = slope_of_map(servo, arrival, length, times)
    largest = max(mp.eig(slope, right=False), key=abs)
    is_real = abs(mp.im(largest)) < mpf("1e-20") * abs(largest)
    return (amplitude, period, mp.re(largest) if is_real else abs(largest)), arrival, slope


def derivatives(_, damping, inertia_ratio, friction_ratio, restitution, backlash, *guess):
    """Amplitude, period and multiplier (of a pair, the modulus) and their derivatives."""
    with mp.workdps(75):
        here = [mpf(x) for x in (damping, inertia_ratio, friction_ratio, restitution)]
        length, times = mpf(guess[3]), []
        values, arrival, slope = cycle(
            Bouncing(*here, backlash), mp.matrix(list(guess[:3])), length, times
        )
        columns = []
        for i in range(4):
            step = here[i] * mpf("1e-14")
            ends = []
            for change in (step, -step):
                numbers = list(here)
                numbers[i] += change
                ends.append(cycle(Bouncing(*numbers, backlash), arrival, length, times, slope)[0])
            columns.append([(a - b) / (2 * step) for a, b in zip(*ends)])
        return [x for number in zip(values, *columns) for x in number]


# Drawn servos and some of every kind of multipliers; then load position, common momentum and gap
# speed of an arrival at the forward face, and the period, all near those of the cycle.
CYCLES = [
    ("drawn", (0.171004838728745, 3.0640802114770214, 0.39596737896175827, 0.648089811811266, 0.5136203792464625,
     -0.269457565391, 0.021224555466, 0.700026696135, 6.44361525758)),
    ("drawn", (0.24398955198162203, 0.39487986275775167, 0.6570918824540255, 0.7386381712575768, 0.048662813487455533,
     -0.0233805991621, 0.0305950799883, 0.0439001536972, 7.26959294607)),
    ("drawn", (0.0867585183763469, 0.33513841091770447, 0.7567737934506141, 0.2531527582263563, 0.5125223749155677,
     -1.47414479234, 0.263370998009, 1.15146179717, 6.14795517338)),
    ("drawn", (0.3902777899818708, 1.3116228874806752, 0.1453205207221461, 0.8288365671285938, 0.38368298537747253,
     -0.172918799041, 0.0439507579578, 0.253420470688, 7.19456272239)),
    ("drawn", (0.11748981018752572, 0.5407068968409718, 0.3811679228306173, 0.2543156387481207, 0.21674808029693307,
     -0.411640106211, 0.0442512743366, 0.428343188878, 6.09933310791)),
    ("drawn", (0.4155225742153682, 0.8159068882052695, 0.6914053004121661, 0.6275766401475882, 0.04939986153127833,
     -0.00798165987301, 0.0125556249291, 0.0229021812808, 9.21953362181)),
    ("drawn", (0.06606598258424964, 0.39580667801307623, 0.5248952054480392, 0.1752646145323772, 0.9839714874295264,
     -3.19230926006, -0.371249479147, 2.4421036593, 6.07561775107)),
    ("drawn", (0.18875794494688303, 0.4170890466250627, 0.7680781362237207, 0.5630750308502187, 0.017500654401397378,
     -0.0182479641266, 0.0150754948348, 0.024739838169, 6.54162402241)),
    ("drawn", (0.27113444830746863, 4.524618963352327, 0.6587994413069692, 0.2186972488283936, 0.036124071573499415,
     -0.00835052826417, 0.00397999278383, 0.0328963785827, 7.6253906339)),
    ("drawn", (0.3765406909771876, 0.8938374999468809, 0.7273658721692053, 0.5285475481396692, 0.41907820788513483,
     -0.0853875228887, 0.130131338596, 0.24930797684, 8.41730631345)),
    ("pair", (0.34, 0.94, 0.48, 0.9, 1.0,
     -0.364228010812, 0.261743469809, 0.635818800041, 6.33109040317)),
    ("opposite", (0.34, 0.94, 0.48, 0.472, 1.0,
     -0.315246765016, 0.299061122003, 0.637114880341, 8.1320335477)),
    ("asymmetric", (0.19, 2.0, 0.1, 0.6, 0.3,
     -0.216979776393, 0.00111806927134, 0.422383229027, 6.52664504239)),
    ("subharmonic", (0.121354, 1.80297, 0.686046, 0.602605, 0.170371,
     -0.141584945053, 0.0447429217725, 0.305790643465, 12.2805315104)),
]

TABLES = [
    Table(
        "question/bouncing_slopes",
        "Limit cycles with bounces (of subharmonic ones over a whole period), and derivatives, of\n"
        "which each is a central difference; the guesses are where the search for them begins.",
        "damping inertia_ratio friction_ratio restitution backlash"
        " guessed_position guessed_momentum guessed_gap_speed guessed_period",
        " ".join(f"{value} {value}:damping {value}:inertia_ratio {value}:friction_ratio"
                 f" {value}:restitution" for value in ("amplitude", "period", "multiplier")),
        derivatives,
        [Family(kind, listed=[numbers]) for kind, numbers in CYCLES],
        seed=1, digits=18, sample=1,
    ),
]
