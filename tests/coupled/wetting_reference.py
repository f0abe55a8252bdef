"""Liquids at rest on solids, in two dimensions: a drop on a plane or a disc, a disc that floats.  Angles in radians, through the liquid."""
import math


def segment(radius, half_angle):
    """area of a circle's segment, and the distance of its centroid from the centre"""
    area = radius * radius * (half_angle - math.sin(half_angle) * math.cos(half_angle))
    return area, 2.0 * radius ** 3 * math.sin(half_angle) ** 3 / (3.0 * area) if area > 0.0 else radius


def bisect(f, low, high):
    """the x between low and high at which f, which rises, is 0"""
    for _ in range(100):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if f(middle) < 0.0 else (low, middle)
    return 0.5 * (low + high)


def on_plane(area, angle):
    """radius of the cap, height of its centroid above the plane, distance of its circle's centre from the plane"""
    radius = math.sqrt(area / (angle - math.sin(angle) * math.cos(angle)))
    return radius, segment(radius, angle)[1] - radius * math.cos(angle), -radius * math.cos(angle)


def of_radius_on_disc(solid, radius, angle):
    """area of the drop, its centroid's and its circle's centre's distance from the disc's centre; the normals of the two circles
    where they meet have the cosine of the angle"""
    distance = math.sqrt(radius ** 2 + solid ** 2 - 2.0 * radius * solid * math.cos(angle))
    inner = math.acos(max(-1.0, min(1.0, (distance ** 2 + radius ** 2 - solid ** 2) / (2.0 * distance * radius))))
    outer = math.acos(max(-1.0, min(1.0, (distance ** 2 + solid ** 2 - radius ** 2) / (2.0 * distance * solid))))
    (a, at), (b, bt) = segment(radius, inner), segment(solid, outer)  # what of the drop's circle is in the disc
    area = math.pi * radius ** 2 - a - b
    return area, (math.pi * radius ** 2 * distance - a * (distance - at) - b * bt) / area, distance


def on_disc(solid, area, angle):
    """as on_plane, from the centre of a disc of radius `solid`"""
    radius = bisect(lambda r: of_radius_on_disc(solid, r, angle)[0] - area, 1e-3 * solid, 20.0 * solid)
    return (radius,) + of_radius_on_disc(solid, radius, angle)[1:]


def meniscus(beta, radius, angle, weight, lift, tension, width, n=2000):
    """A disc with contact lines at the angle beta from its lowest point in a tank of half width `width` with walls at 90 degrees; weight
    less that of the displaced gas, N/m; lift: (rho_w - rho_a) g.  Balance of forces (Bhatnagar and Finn, Phys. Fluids 18, 2006):
    weight = lift (segment + depth chord) + 2 tension sin(slope).  Slope at the wall, half the area of the water above the level at which it
    has the gas's pressure, the disc's centre above that; None where the interface is steep."""
    slope = beta + angle - math.pi
    below = segment(radius, beta)[0]
    x, y = radius * math.sin(beta), -(weight - 2.0 * tension * math.sin(slope) - lift * below) / (2.0 * lift * radius * math.sin(beta))
    area, centre, step = y * x - 0.5 * below, y + radius * math.cos(beta), (width - x) / n

    def rate(y, slope):
        return math.tan(slope), lift * y / tension / math.cos(slope)

    for _ in range(n):
        if abs(slope) > 1.5:
            return None
        k = rate(y, slope)
        l = rate(y + 0.5 * step * k[0], slope + 0.5 * step * k[1])
        m = rate(y + 0.5 * step * l[0], slope + 0.5 * step * l[1])
        p = rate(y + step * m[0], slope + step * m[1])
        area += step * (y + step * (k[0] + l[0] + m[0]) / 6.0)
        y += step * (k[0] + 2.0 * l[0] + 2.0 * m[0] + p[0]) / 6.0
        slope += step * (k[1] + 2.0 * l[1] + 2.0 * m[1] + p[1]) / 6.0
    return slope, area, centre


def floating(radius, angle, weight, lift, tension, width, half_area):
    """height of a floating disc's centre over the level y = 0 above which there would be half_area of water, and beta"""
    last = None
    for k in range(4, 624):
        beta = 0.005 * k
        now = meniscus(beta, radius, angle, weight, lift, tension, width, 200)
        if last and now and last[0] * now[0] < 0.0:
            sign = 1.0 if now[0] > 0.0 else -1.0
            beta = bisect(lambda b: sign * meniscus(b, radius, angle, weight, lift, tension, width)[0], beta - 0.005, beta)
            found = meniscus(beta, radius, angle, weight, lift, tension, width)
            return found[2] + (half_area - found[1]) / width, beta
        last = now
    return None
