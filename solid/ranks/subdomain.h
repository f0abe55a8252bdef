/* Sums over the ranks that share a node.  Each element belongs to one rank; a node at the border of several ranks'
 * elements is on all of them, and what acts on it is the sum of their parts.
 *
 *     rank 0  ...--a--b            the parts of b and c travel both ways and are added in order of the ranks,
 *             ...--d--c            so that all copies get the same bits and never drift apart
 *     rank 1          b--e--...
 *                     c--f--... */
#ifndef SOLID_SUBDOMAIN_H
#define SOLID_SUBDOMAIN_H
#include <petscsys.h>

typedef struct Subdomain_s *Subdomain;

/* Not collective.  n copies: local node[k] is also on rank[k]; sorted by rank and then by the nodes' global
 * numbers.  nnodes: local nodes. */
PetscErrorCode SubdomainCreate(MPI_Comm comm, int nnodes, int n, const int rank[], const int node[],
                               Subdomain *s);
/* Collective over neighbours: value[nnodes][2] becomes the sum over the ranks.  No messages where nothing is
 * shared. */
PetscErrorCode SubdomainSum(Subdomain s, double value[]);
/* The same with the least instead of the sum. */
PetscErrorCode SubdomainMin(Subdomain s, double value[]);
/* Not collective: no lower rank has the node. */
PetscBool SubdomainOwns(Subdomain s, int node);
PetscErrorCode SubdomainDestroy(Subdomain *s);
#endif
