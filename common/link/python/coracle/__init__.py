"""Coracle's client library for Python: how a solid or a fluid written in Python joins a coupled run.

Arrays are numpy's, C-contiguous, of float64, intc or longlong; they are handed to the library and from it without a copy.
What each call means, when it is allowed and which units it has is said in coracle.h; this package keeps its names and order:

    client = coracle.Client("solid")        # CoracleOpen with sys.argv; client.comm is an mpi4py communicator
    client.bind_state(state)
    client.set_nodes(gid, x, u); client.set_surface(facets); client.set_volume(triangles)
    client.ready()
    for step in client.steps():             # CoracleBegin until CORACLE_STOP; step.t, step.dt, step.redo
        force = client.get_force()
        client.substep(step.dt, u)
        client.end(x)
    client.close()

An exception that nobody catches ends the whole job with one message.
"""
from coracle.case import Case
from coracle.client import REDO, RUN, STOP, Client
from coracle.library import CORRECTION, COUPLING, GAUGE, HAS_INERTIA, HAS_SHELL, IS_COVERED, IS_HELD, version

__all__ = ["Case", "Client", "CORRECTION", "COUPLING", "GAUGE", "HAS_INERTIA", "HAS_SHELL", "IS_COVERED", "IS_HELD", "REDO", "RUN", "STOP", "version"]
