/* The solid alone: the same case file, outputs and substeps, but neither coupler nor fluid.  Its steps are
 * time.dt_max long (the rows of solid.csv) and end with time.end; there is no
 * fluid around the bodies.  Checkpoints are those of other runs, with the solid's part alone. */
#ifndef SOLID_ALONE_H
#define SOLID_ALONE_H

/* Takes --alone out of argv; nonzero if it was there. */
int AloneTake(int *argc, char **argv);
/* The whole program, argv without --alone; returns its exit code. */
int Alone(int argc, char **argv);
#endif
