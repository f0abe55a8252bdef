/* Private to the examination of a fluid: the attempts of a step, and what the fluid is sent for each. */
#ifndef CORACLE_CONFORMANCE_ATTEMPTS_H
#define CORACLE_CONFORMANCE_ATTEMPTS_H
#include "common/conformance/patch.h"

/* The attempts of a step that repeats, in their order (examine.h). */
typedef enum { HELD, MORE, FREE, SOURCE, COEFFICIENT, BULK, INERTIA, KEPT, COVERED, AGAIN, KINDS } Kind;

#define SHORT 1e-6 /* tau/dt */

typedef struct {
  double *u_start, *u_star, *u_projected; /* [n][2][3] m/s */
} Flow;

typedef struct {
  Kit *kit;
  Patch patch;
  CoracleCoupling *coupling; /* [patch.ncoupled], of the current attempt */
  CoracleCorrection *correction;
  Flow flow[KINDS]; /* of the current step, by attempt */
  double momentum[2],
      corrected[2]; /* kg m/s: at the end of the last step, and what its correction has added */
  bool known;       /* they are those of these elements */
  double w[2];      /* m/s: velocity scale */
} Fluid;

/* CoracleCoupling.kept and inertia_tensor of attempt KEPT. */
extern const double AttemptKept[2][2], AttemptTensor[2][2];
/* The solid's inertia is among what is sent. */
bool AttemptHasInertia(Kind kind);
/* s: of the attempt's step */
double AttemptStep(const Fluid *f, Kind kind);
/* The velocity that the disc is driven to, m/s: V, or V + G. */
void AttemptTarget(const Fluid *f, Kind kind, double v[2]);
/* Collective: the coupling of the attempt, after ncorrection entries of f->correction. */
void AttemptSend(Fluid *f, Kind kind, CoracleAction action, int ncorrection);
/* Collective: r of the accepted step, and what it adds to the momentum: int N (V - u+). */
void AttemptCorrection(Fluid *f);
#endif
