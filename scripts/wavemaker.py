#!/usr/bin/env python3
"""The motion of a piston or a flap that makes waves, as the prescribed motion of a body in a case file.

Usage: scripts/wavemaker.py regular   --height H --period T --depth D --end TIME [--rise TIME]
       scripts/wavemaker.py solitary  --height H --depth D [--start TIME]
       scripts/wavemaker.py irregular --height HS --period TP --depth D --end TIME [--gamma 3.3] [--seed 1] [--components 100] [--rise TIME]
all with [--rows DT] [--gravity 9.81] [--line], regular and irregular with [--flap X Y].  Lengths in m, times in s.

Prints `prescribed` with its table of time and velocity, to paste into the body's item of solid.bodies; the waves and the stroke are told in comments.
With --line only the table, in one line without comments:
    scripts/launch.sh CASE --set "solid.bodies[0].prescribed=[{table: $(scripts/wavemaker.py solitary --height 0.06 --depth 0.4 --line)}]"
The piston moves along x and stands in the water from the floor to above the crests; the waves go to larger x.  --flap: instead of it a flap that turns
about a hinge at the floor, (X, Y); the table is one of time and angular velocity, for `angular_velocity`.

regular    first order: the stroke by the transfer function of Biesel, H/S = 4 sinh^2 kd/(sinh 2kd + 2kd), omega^2 = g k tanh kd; of a flap
           H/S = 4 sinh kd (sinh kd - (cosh kd - 1)/kd)/(sinh 2kd + 2kd), S its stroke at still water's level
solitary   Goring (1978): the piston moves with the mean velocity of the water beside it in the wave H sech^2 kappa (c t - x) of Boussinesq
irregular  the spectrum of JONSWAP from 0.5 to 3 times the frequency of its peak: components of equal energy with random phases, the frequency of
           each at random within its band, the stroke of each by Biesel; long waves of second order are not corrected for
Regular and irregular waves rise smoothly, end at --end, and the piston comes to rest as smoothly as it began: the velocity of a
table's last row is kept after it.
"""
import argparse
import sys

import numpy as np

MOST_ROWS = 100000
STEEPEST = 0.142  # H/L over tanh kd, of waves that do not break (Miche)
HIGHEST = 0.78  # H/d of a solitary wave
SMALLEST = 1e-3  # of a solitary wave's height, where its motion begins and ends


def refuse(text):
    sys.exit("wavemaker.py: error: " + text)


def wave_number(omega, depth, gravity):
    """k of omega^2 = g k tanh kd, 1/m, by Newton's method; omega: a number or an array."""
    a = omega**2 * depth / gravity
    y = a / np.sqrt(np.tanh(a))
    for _ in range(20):
        y = y - (y * np.tanh(y) - a) / (np.tanh(y) + y / np.cosh(np.minimum(y, 300.0))**2)
    return y / depth


def height_over_stroke(kd, flap=False):
    """Of a piston; of a flap hinged at the floor at still water's level."""
    q = np.exp(-2.0 * kd)
    other = (1.0 - np.exp(-kd))**2 / kd if flap else 0.0  # 2 e^-kd (cosh kd - 1)/kd
    return 2.0 * (1.0 - q) * (1.0 - q - other) / (1.0 - q**2 + 4.0 * kd * q)


def smooth(t, rise):
    """From 0 at t = 0 to 1 at `rise`, half a cosine, and its rate."""
    phase = np.pi * np.clip(t / rise, 0.0, 1.0)
    return 0.5 * (1.0 - np.cos(phase)), 0.5 * np.pi / rise * np.sin(phase)


def piston(t, omega, stroke, phase, rise, end):
    """Displacement and velocity at t: of -stroke/2 cos(omega t + phase), summed over components, that begins smoothly and ends after `end`."""
    x, u = np.zeros_like(t), np.zeros_like(t)
    for w, s, p in zip(omega, stroke, phase):
        x -= 0.5 * s * np.cos(w * t + p)
        u += 0.5 * s * w * np.sin(w * t + p)
    (begins, rate), (ends, fall) = smooth(t, rise), smooth(end + rise - t, rise)
    return begins * ends * x, begins * ends * u + (rate * ends - begins * fall) * x


def times(length, spacing, default):
    """0, spacing, ... until after `length`."""
    spacing = spacing or default
    if spacing > 5.0 * default:
        refuse("--rows %g: too coarse for this motion, expected at most %.4g" % (spacing, 5.0 * default))
    if length / spacing > MOST_ROWS:
        refuse("more than %d rows: expected a larger --rows or a smaller --end" % MOST_ROWS)
    return spacing * np.arange(np.ceil(length / spacing - 1e-9) + 1.0)


def wave_number_below_breaking(o):
    """k of the period; ends the program where waves of this height break."""
    k = wave_number(2.0 * np.pi / o.period, o.depth, o.gravity)
    highest = STEEPEST * np.tanh(k * o.depth) * 2.0 * np.pi / k
    if o.height > highest:
        refuse("--height %g: waves of %g s in water %g m deep break above %.4g m" % (o.height, o.period, o.depth, highest))
    return k


def jonswap(f, peak, gamma):
    """The spectrum over frequencies f but for a factor."""
    width = np.where(f <= peak, 0.07, 0.09)
    return f**-5.0 * np.exp(-1.25 * (peak / f)**4) * gamma**np.exp(-0.5 * ((f / peak - 1.0) / width)**2)


def regular(o):
    omega, rise = 2.0 * np.pi / o.period, o.rise or 2.0 * o.period
    k = wave_number_below_breaking(o)
    stroke = o.height / height_over_stroke(k * o.depth, bool(o.flap))
    t = times(o.end + rise, o.rows, o.period / 50.0)
    text = ["regular waves, H %g m, T %g s, in water %g m deep" % (o.height, o.period, o.depth),
            "k %.6g 1/m, wave length %.6g m, steepness H/L %.4g, kd %.4g" % (k, 2.0 * np.pi / k, o.height * k / (2.0 * np.pi), k * o.depth),
            "stroke S %.6g m, H/S %.6g" % (stroke, o.height / stroke)]
    if not o.flap:
        text.append("the same with a linear rise, and no end: {velocity: [%.6g, 0], period: %g, rise: %g}" % (0.5 * stroke * omega, o.period, rise))
    return (t, *piston(t, [omega], [stroke], [0.0], rise, o.end), text)


def solitary(o):
    """X = H/(kappa d) tanh theta with theta = kappa (c t - X); theta by Newton's method."""
    if o.height > HIGHEST * o.depth:
        refuse("--height %g: a solitary wave in water %g m deep breaks above %.4g m" % (o.height, o.depth, HIGHEST * o.depth))
    if not 0.0 <= o.start < np.inf:
        refuse("--start %g: expected a number >= 0" % o.start)
    kappa, c, ratio = np.sqrt(0.75 * o.height / o.depth**3), np.sqrt(o.gravity * (o.depth + o.height)), o.height / o.depth
    first = np.arccosh(SMALLEST**-0.5)
    duration = 2.0 * (first + ratio * np.tanh(first)) / (kappa * c)
    t = times(duration, o.rows, float("%.1g" % (duration / 100.0)))
    phase = kappa * c * (t - 0.5 * duration)
    theta = phase / (1.0 + ratio)  # between 0 and the root
    for _ in range(30):
        theta -= (theta + ratio * np.tanh(theta) - phase) / (1.0 + ratio / np.cosh(theta)**2)
    eta = o.height / np.cosh(theta)**2
    x, u = ratio / kappa * (np.tanh(theta) + np.tanh(first)), c * eta / (o.depth + eta)
    u[0] = u[-1] = 0.0
    text = ["a solitary wave, H %g m, in water %g m deep" % (o.height, o.depth),
            "celerity c %.6g m/s, kappa %.6g 1/m, stroke %.6g m" % (c, kappa, 2.0 * ratio / kappa),
            "the piston moves for %.6g s from %g s on; the crest is beside it at %.6g s" % (duration, o.start, o.start + 0.5 * duration)]
    return t + o.start, x, u, text


def irregular(o):
    peak, rise = wave_number_below_breaking(o), o.rise or 2.0 * o.period
    if o.end < 2.0 * rise:
        refuse("--end %g: the waves rise until %g s: expected twice that or more" % (o.end, rise))
    rng, f = np.random.default_rng(o.seed), np.linspace(0.5, 3.0, 20001) / o.period
    energy = np.cumsum(jonswap(f, 1.0 / o.period, o.gamma))
    bands = (np.arange(o.components) + rng.random(o.components)) / o.components
    omega = 2.0 * np.pi * np.interp(energy[0] + bands * (energy[-1] - energy[0]), energy, f)
    phase = 2.0 * np.pi * rng.random(o.components)
    amplitude = 0.25 * o.height * np.sqrt(2.0 / o.components)
    k = wave_number(omega, o.depth, o.gravity)
    t = times(o.end + rise, o.rows, o.period / 50.0)
    x, u = piston(t, omega, 2.0 * amplitude / height_over_stroke(k * o.depth, bool(o.flap)), phase, rise, o.end)
    full = t[(t >= rise) & (t <= o.end)]
    eta = sum(amplitude * np.sin(w * full + p) for w, p in zip(omega, phase))
    text = ["irregular waves, Hs %g m, Tp %g s, in water %g m deep: JONSWAP, gamma %g, %d components, seed %d" %
            (o.height, o.period, o.depth, o.gamma, o.components, o.seed),
            "at the peak: wave length %.6g m" % (2.0 * np.pi / peak),
            "four standard deviations of the elevation beside it, %g s to %g s: %.4g m (Hs %g m)" % (rise, o.end, 4.0 * eta.std(), o.height)]
    return t, x, u, text


def positive(text):
    value = float(text)
    if not 0.0 < value < np.inf:
        raise argparse.ArgumentTypeError("expected a number > 0, found '%s'" % text)
    return value


def count(text):
    return int(positive(str(int(text))))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    kinds = parser.add_subparsers(dest="waves", required=True)
    for make in (regular, solitary, irregular):
        kind = kinds.add_parser(make.__name__)
        kind.set_defaults(make=make)
        kind.add_argument("--height", type=positive, required=True, help="from trough to crest, m; of irregular waves the significant one")
        kind.add_argument("--depth", type=positive, required=True, help="of still water, m")
        kind.add_argument("--gravity", type=positive, default=9.81, help="m/s2")
        kind.add_argument("--rows", type=positive, metavar="DT", help="from row to row, s; default a fiftieth of the period, a hundredth of a solitary wave")
        kind.add_argument("--line", action="store_true", help="the table alone, in one line, for --set")
        if make is solitary:
            kind.add_argument("--start", type=float, default=0.0, help="when the motion begins, s")
        else:
            kind.add_argument("--period", type=positive, required=True, help="s; of irregular waves that of the spectrum's peak")
            kind.add_argument("--end", type=positive, required=True, help="until when there are waves, s; then the piston comes to rest")
            kind.add_argument("--flap", type=float, nargs=2, metavar=("X", "Y"), help="a flap's hinge, at the floor")
            kind.add_argument("--rise", type=positive, help="in which waves become as high as asked for, s; default two periods")
    kind.add_argument("--gamma", type=positive, default=3.3, help="peak enhancement of the spectrum")
    kind.add_argument("--seed", type=count, default=1)
    kind.add_argument("--components", type=count, default=100)
    options = parser.parse_args()
    t, x, u, text = options.make(options)
    flap = getattr(options, "flap", None)
    if flap:  # x = d tan of the angle, which is clockwise
        u = -u * options.depth / (options.depth**2 + x**2)
    rows = [("[%.9g, %.6g]" if flap else "[%.9g, %.6g, 0]") % row for row in zip(t, np.round(u, 9) + 0.0)]
    if options.line:
        print("[%s]" % ", ".join(rows))
        return
    what = "the flap at still water's level" if flap else "the piston"
    text.append("%s is between %.4g m and %.4g m from where it begins, at most as fast as %.4g %s" % (what, x.min(), x.max(), abs(u).max(), "rad/s" if flap else "m/s"))
    print("\n".join("      # " + line for line in text))
    print("      prescribed:")
    print("        - pivot: [%.9g, %.9g]\n          angular_velocity:   # s, rad/s" % tuple(flap) if flap else "        - table:   # s, m/s")
    print("\n".join("            - " + row for row in rows))


if __name__ == "__main__":
    main()
