"""A participant: the calls of coracle.h in their order."""
import ctypes
import sys
import traceback

import numpy as np
from mpi4py import MPI

from coracle.case import Case
from coracle.library import (CORRECTION, COUPLING, GAUGE, REGION_FUNCTION, STATE_FUNCTION, Flow, array, byref, c_double, c_int, c_void_p,
                             call, view, words)

RUN, REDO, STOP = 0, 1, 2


class Step:
    """From t over dt, s; redo: bound state has been restored to t."""

    def __init__(self, t, dt, redo):
        self.t, self.dt, self.redo = t, dt, redo


class Client:
    """Joins the job as `role`, "fluid" or "solid"; argv: program, case file, --set key=value ...; job: an mpi4py communicator of the
    participants' ranks (default: MPI.COMM_WORLD).  comm: this participant's communicator, a copy that outlives close: Python destroys
    what was made on it (PETSc's objects) in an order of its own."""

    def __init__(self, role, argv=None, job=None):
        self._argv = list(sys.argv if argv is None else argv)
        self._words, self._handle, handle = words(self._argv), c_void_p(), c_int()
        world = None if job is None else byref(c_int(job.py2f()))
        call("OpenFortran", world, role.encode(), len(self._argv), self._words, byref(handle), byref(self._handle))
        self.comm = MPI.Comm.f2py(handle.value).Dup()
        self.n = self._n_start = 0  # the solid's nodes on this rank
        self._elements = 0  # the fluid's elements last given by region
        self._kept = []  # what the library points to
        self._answer = ()  # to the last call of region
        sys.excepthook = self._end_job

    def _end_job(self, kind, error, trace):
        traceback.print_exception(kind, error, trace)
        where = traceback.extract_tb(trace)[-1]
        self.fail(f"{kind.__name__}: {error} ({where.filename}:{where.lineno})")

    def case(self):
        return Case(self._handle, self._argv)

    def fail(self, message):
        """Ends the whole job; not collective."""
        sys.stdout.flush()
        call("FailMessage", self._handle, message.encode())

    def report(self, key, value, total=False):
        call("Report", self._handle, key.encode(), value, total)

    def phase(self, name=None):
        """What this rank computes from now on, in the run's trace."""
        call("Phase", self._handle, name.encode() if name else None)

    def close(self):
        call("Close", byref(self._handle))
        sys.excepthook = sys.__excepthook__

    # --- the run

    def bind_state(self, *arrays):
        """Each array is saved when a step begins and restored in place when it is redone, and in a run that resumes."""
        for values in arrays:
            if not (isinstance(values, np.ndarray) and values.flags.c_contiguous and values.flags.writeable):
                raise TypeError("bind_state: expected C-contiguous arrays that can be written")
            self._kept.append(values)
            call("BindState", self._handle, values.ctypes.data, values.nbytes)

    def bind_state_function(self, function):
        """function(save): saves its state (True) or restores it (False)."""
        self._kept.append(STATE_FUNCTION(lambda _, save: self._guard(lambda: function(bool(save)))))
        call("BindStateFunction", self._handle, self._kept[-1], None)

    def _guard(self, function):
        """A callback's exception must not be lost in C."""
        try:
            function()
        except BaseException:  # noqa: the job ends
            self._end_job(*sys.exc_info())
        return 0

    def ready(self):
        call("Ready", self._handle)

    def begin(self):
        """(t, dt, action)"""
        t, dt, action = c_double(), c_double(), c_int()
        call("Begin", self._handle, byref(t), byref(dt), byref(action))
        if action.value == REDO:
            self.n = self._n_start
        self._n_start = self.n
        return t.value, dt.value, action.value

    def steps(self):
        """The steps of the run, each as often as it is made."""
        while True:
            t, dt, action = self.begin()
            if action == STOP:
                return
            yield Step(t, dt, action == REDO)

    def end(self, x=None):
        """A solid's new positions x[n][2], m; nothing for a fluid."""
        call("End", self._handle, array("x", x, (self.n, 2)))

    def reject_step(self, why):
        """The step cannot be made; end() follows all the same, a solid's without positions."""
        call("RejectStep", self._handle, why.encode())

    def checkpoint_path(self):
        path = call("CheckpointPath", self._handle)
        return path.decode() if path else None

    def resume_path(self):
        path = call("ResumePath", self._handle)
        return path.decode() if path else None

    # --- the solid

    def set_nodes(self, gid, x, u):
        n = len(gid)
        arrays = array("gid", gid, (n,), np.longlong), array("x", x, (n, 2)), array("u", u, (n, 2))
        self.n = n
        call("SetNodes", self._handle, 2, n, *arrays)

    def set_surface(self, facets):
        call("SetSurface", self._handle, len(facets), array("facets", facets, (-1, 2), np.intc))

    def set_volume(self, triangles):
        call("SetVolume", self._handle, len(triangles), array("triangles", triangles, (-1, 3), np.intc))

    def set_inertia(self, mobility, acceleration):
        call("SetInertia", self._handle, array("mobility", mobility, (self.n,)), array("acceleration", acceleration, (self.n, 2)))

    def set_pressure_load(self):
        call("SetPressureLoad", self._handle)

    def get_force(self):
        """force[n][2], N; a view that holds until end."""
        force = c_void_p()
        call("GetForce", self._handle, byref(force))
        return view(force.value, (self.n, 2))

    def get_film(self):
        """load[n][2], N, and resistance[n][2][2], N s/m, views that hold until end; (None, None) where no film yields."""
        load, resistance = c_void_p(), c_void_p()
        call("GetFilm", self._handle, byref(load), byref(resistance))
        if load.value is None:
            return None, None
        return view(load.value, (self.n, 2)), view(resistance.value, (self.n, 2, 2))

    def substep(self, h, u):
        call("Substep", self._handle, h, array("u", u, (self.n, 2)))

    def set_velocity(self, u):
        call("SetVelocity", self._handle, array("u", u, (self.n, 2)))

    # --- the fluid

    def get_region(self):
        """boxes[nbox][2][2]: lower and upper corners, m; a view that holds until ready."""
        n, box = c_int(), c_void_p()
        call("GetRegion", self._handle, byref(n), byref(box))
        return view(box.value, (n.value, 2, 2))

    def set_region(self, lower, upper, region):
        """region(boxes): (x[n][3][2], rho[n], mu[n]) of this rank's elements that overlap any box."""
        def answer(_, nbox, box, elements):
            def fill():
                x, rho, mu = self._answer = region(view(ctypes.cast(box, c_void_p).value, (nbox, 2, 2)))
                n = self._elements = elements[0].n = len(rho)
                elements[0].x, elements[0].rho = array("x", x, (n, 3, 2)), array("rho", rho, (n,))
                elements[0].mu = array("mu", mu, (n,))
            return self._guard(fill)
        self._kept.append(REGION_FUNCTION(answer))
        bounds = [np.ascontiguousarray(b, np.float64) for b in (lower, upper)]
        call("SetRegion", self._handle, 2, *(array("bounds", b, (2,)) for b in bounds), self._kept[-1], None)

    def elements_changed(self):
        call("ElementsChanged", self._handle)

    def propose_step(self, dt):
        call("ProposeStep", self._handle, dt)

    def needs_pressure(self):
        return bool(call("NeedsPressure", self._handle))

    def _entries(self, name, dtype):
        n, entries = c_int(), c_void_p()
        call(name, self._handle, byref(n), byref(entries))
        return view(entries.value, (n.value,), dtype)

    def get_coupling(self):
        """An array of COUPLING, a view that holds until end."""
        return self._entries("GetCoupling", COUPLING)

    def set_flow(self, u_start, u_star, u_projected, rho, mu, p=None):
        n = self._elements
        flow = Flow(array("u_start", u_start, (n, 2, 3)), array("u_star", u_star, (n, 2, 3)), array("u_projected", u_projected, (n, 2, 3)), array("p", p, (n, 6)),
                    array("rho", rho, (n,)), array("mu", mu, (n,)))
        call("SetFlow", self._handle, byref(flow))

    def step_accepted(self):
        return bool(call("StepAccepted", self._handle))

    def get_correction(self):
        """An array of CORRECTION, a view that holds until the next end."""
        return self._entries("GetCorrection", CORRECTION)

    def get_gauges(self):
        """An array of GAUGE, a view that holds until the next end."""
        return self._entries("GetGauges", GAUGE)
