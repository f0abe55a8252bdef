/* Wakes a rank that sleeps until a message comes: a counter for each rank of a computer, in memory that they share.
 * Who sends a message to a rank, or takes one from it, rings there; who waits sleeps until its counter changes
 * (a futex of Linux), so that waiting needs no processor and ends at once.
 *
 *     sleeper                                     partner
 *     rings = DoorbellRings                       MPI_Isend
 *     look for the message: not there             DoorbellRing
 *     DoorbellSleep(rings): returns at once if it has been rung since
 *
 * Open and close are collective over the job; the rest is local and needs no MPI. */
#ifndef CORACLE_DOORBELL_H
#define CORACLE_DOORBELL_H
#include <mpi.h>
#include <stdbool.h>
#include <stdint.h>

typedef struct Doorbell_s *Doorbell;

int DoorbellOpen(MPI_Comm job, Doorbell *doorbell);
int DoorbellClose(Doorbell *doorbell);
/* Whether rank of the job is on this computer: others cannot ring here, nor be rung. */
bool DoorbellReaches(Doorbell doorbell, int rank);
/* Nothing happens if it is not reached. */
void DoorbellRing(Doorbell doorbell, int rank);
/* How often this rank has been rung so far. */
uint32_t DoorbellRings(Doorbell doorbell);
/* Returns when this rank has been rung more than `rings` times, after so many seconds, or on a signal. */
void DoorbellSleep(Doorbell doorbell, uint32_t rings, double seconds);
#endif
