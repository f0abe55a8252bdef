"""The shared library: its functions with their types, its structures as numpy dtypes."""
import ctypes
import os
from ctypes import POINTER, byref, c_bool, c_char_p, c_double, c_int, c_longlong, c_size_t, c_void_p

import numpy as np

from coracle.location import LIBRARY, VERSION

HAS_SHELL, HAS_INERTIA, IS_COVERED, IS_HELD = 1, 2, 4, 8
_MATRIX, _LOAD = (np.float64, (3, 3)), (np.float64, (2, 3))
# CoracleCoupling and CoracleCorrection of coracle.h
COUPLING = np.dtype([("element", np.intc), ("flags", np.intc), ("a", np.float64, (2, 3, 2, 3)), ("implicit_inertia", *_MATRIX),
                     ("inertia_tensor", np.float64, (2, 2)), ("kept", np.float64, (2, 2)),
                     ("s", *_LOAD), ("ms", *_MATRIX), ("us", *_LOAD), ("velocity", np.float64, 2), ("alpha", np.float64),
                     ("shell", np.float64)], align=True)
CORRECTION = np.dtype([("element", np.intc), ("r", *_LOAD)], align=True)
GAUGE = np.dtype([("x", np.float64, (2,)), ("normal", np.float64, (2,))], align=True)


class Elements(ctypes.Structure):
    _fields_ = [("n", c_int)] + [(name, c_void_p) for name in ("x", "rho", "mu", "rho_inside", "rho_beside")]


class Flow(ctypes.Structure):
    _fields_ = [(name, c_void_p) for name in ("u_start", "u_star", "u_projected", "p", "rho", "mu", "rho_inside", "rho_beside", "remainder")]


STATE_FUNCTION = ctypes.CFUNCTYPE(c_int, c_void_p, c_int)
REGION_FUNCTION = ctypes.CFUNCTYPE(c_int, c_void_p, c_int, POINTER(c_double), POINTER(Elements))
FAIL_FUNCTION = ctypes.CFUNCTYPE(None, c_void_p, c_char_p)

_C, _A = c_void_p, c_void_p  # a handle, an array
_SIGNATURES = {
    "Version": (c_char_p,), "OpenFortran": (c_int, _A, c_char_p, c_int, POINTER(c_char_p), POINTER(c_int), POINTER(_C)),
    "FailMessage": (None, _C, c_char_p), "Report": (c_int, _C, c_char_p, c_double, c_int), "Phase": (c_int, _C, c_char_p),
    "Close": (c_int, POINTER(_C)),
    "SetNodes": (c_int, _C, c_int, c_int, _A, _A, _A), "SetSurface": (c_int, _C, c_int, _A), "SetVolume": (c_int, _C, c_int, _A),
    "SetInertia": (c_int, _C, _A, _A), "SetPressureLoad": (c_int, _C), "SetVelocity": (c_int, _C, _A), "Substep": (c_int, _C, c_double, _A),
    "GetForce": (c_int, _C, POINTER(_A)), "BindState": (c_int, _C, _A, c_size_t),
    "BindStateFunction": (c_int, _C, STATE_FUNCTION, _A), "Ready": (c_int, _C),
    "Begin": (c_int, _C, POINTER(c_double), POINTER(c_double), POINTER(c_int)), "End": (c_int, _C, _A), "RejectStep": (c_int, _C, c_char_p),
    "CheckpointPath": (c_char_p, _C), "ResumePath": (c_char_p, _C),
    "GetRegion": (c_int, _C, POINTER(c_int), POINTER(_A)), "SetRegion": (c_int, _C, c_int, _A, _A, REGION_FUNCTION, _A),
    "ElementsChanged": (c_int, _C), "ProposeStep": (c_int, _C, c_double), "NeedsPressure": (c_int, _C),
    "GetCoupling": (c_int, _C, POINTER(c_int), POINTER(_A)), "SetFlow": (c_int, _C, POINTER(Flow)),
    "StepAccepted": (c_int, _C), "GetCorrection": (c_int, _C, POINTER(c_int), POINTER(_A)),
    "GetGauges": (c_int, _C, POINTER(c_int), POINTER(_A)),
    "CaseOpen": (c_int, c_int, POINTER(c_char_p), _A, _A, POINTER(_C)), "CaseClose": (c_int, POINTER(_C)),
    "CaseHas": (c_bool, _C, c_char_p), "CaseCount": (c_int, _C, c_char_p),
    "CaseNumber": (c_double, _C, c_char_p, c_double, c_double), "CasePositive": (c_double, _C, c_char_p),
    "CaseNumberOr": (c_double, _C, c_char_p, c_double, c_double, c_double),
    "CaseIntegerOr": (c_int, _C, c_char_p, c_int, c_int, c_int), "CaseBoolOr": (c_bool, _C, c_char_p, c_bool),
    "CaseVector": (None, _C, c_char_p, c_int, _A), "CaseString": (c_char_p, _C, c_char_p),
    "CaseStringOr": (c_char_p, _C, c_char_p, c_char_p), "CaseFile": (c_char_p, _C, c_char_p),
    "CaseFinish": (c_int, _C, POINTER(c_char_p)),
}


def _load():
    path = os.environ.get("CORACLE_LIBRARY") or os.path.join(os.path.dirname(os.path.abspath(__file__)), LIBRARY)
    library = ctypes.CDLL(path)
    for name, (result, *arguments) in _SIGNATURES.items():
        function = getattr(library, "Coracle" + name)
        function.restype, function.argtypes = result, arguments
    found = library.CoracleVersion().decode()
    if found != VERSION:
        raise ImportError(f"coracle: {path} is version {found}, this package {VERSION}")
    return library


_library = _load()


def call(name, *arguments):
    """Coracle<name>(...): ends the job itself when something is wrong."""
    return getattr(_library, "Coracle" + name)(*arguments)


def address(name):
    """A function of the library as a pointer, for callbacks."""
    return ctypes.cast(getattr(_library, "Coracle" + name), c_void_p)


def version():
    return VERSION


def words(arguments):
    """char *argv[], with the NULL behind it."""
    encoded = [a.encode() for a in arguments]
    return (c_char_p * (len(encoded) + 1))(*encoded, None)


def array(name, values, shape, dtype=np.float64):
    """The address of an array; TypeError when it is not what C expects (-1 in shape: any)."""
    if values is None:
        return None
    fits = (isinstance(values, np.ndarray) and values.dtype == dtype and values.flags.c_contiguous and values.ndim == len(shape)
            and all(s in (-1, v) for s, v in zip(shape, values.shape)))
    if not fits:
        found = f"{values.dtype} of shape {values.shape}" if isinstance(values, np.ndarray) else type(values).__name__
        expected = ", ".join("any" if s == -1 else str(s) for s in shape)
        raise TypeError(f"{name}: expected a C-contiguous array of {np.dtype(dtype).name} of shape ({expected}), found {found}")
    return values.ctypes.data


def view(pointer, shape, dtype=np.float64):
    """Memory of the library as an array that cannot be written."""
    count = int(np.prod(shape)) * np.dtype(dtype).itemsize
    if count == 0:
        return np.empty(shape, dtype)
    values = np.ndarray(shape, dtype, (ctypes.c_char * count).from_address(pointer))
    values.flags.writeable = False
    return values


__all__ = ["CORRECTION", "COUPLING", "Elements", "Flow", "GAUGE", "HAS_INERTIA", "HAS_SHELL", "IS_COVERED", "IS_HELD", "REGION_FUNCTION", "STATE_FUNCTION", "address",
           "array", "byref", "c_double", "c_int", "c_longlong", "c_void_p", "call", "version", "view", "words"]
