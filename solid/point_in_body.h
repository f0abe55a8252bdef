/* Which element has a point, for probes and springs. */
#ifndef SOLID_POINT_IN_BODY_H
#define SOLID_POINT_IN_BODY_H

/* Barycentric coordinate of a point that counts as inside. */
#define POINT_ON_EDGE 1e-9
/* Of a side's length: a point that is outside of all bodies by less is on the nearest side.  A circle is outside of its polygon by up to 0.06 of a
 * side's length with 12 sides. */
#define POINT_NEAR 0.1

#endif
