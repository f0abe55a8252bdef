"""The case file, strict as for C (case_file.h): what is wrong ends the job with file, line, key and what was expected."""
import math

import numpy as np

from coracle.library import address, byref, c_void_p, call, words


class Case:
    def __init__(self, client, argv):
        self._handle, self._argv = c_void_p(), words(argv)
        call("CaseOpen", len(argv), self._argv, address("FailMessage"), client, byref(self._handle))

    def has(self, key):
        return call("CaseHas", self._handle, key.encode())

    def count(self, key):
        """Number of items of the list at key; 0 if absent."""
        return call("CaseCount", self._handle, key.encode())

    def number(self, key, default=None, lower=-math.inf, upper=math.inf):
        if default is None:
            return call("CaseNumber", self._handle, key.encode(), lower, upper)
        return call("CaseNumberOr", self._handle, key.encode(), default, lower, upper)

    def positive(self, key):
        return call("CasePositive", self._handle, key.encode())

    def integer(self, key, default, lower=-2**31, upper=2**31 - 1):
        return call("CaseIntegerOr", self._handle, key.encode(), default, lower, upper)

    def boolean(self, key, default):
        return call("CaseBoolOr", self._handle, key.encode(), default)

    def vector(self, key, n=2, default=None):
        if default is not None and not self.has(key):
            return np.array(default, dtype=np.float64)
        values = np.zeros(n)
        call("CaseVector", self._handle, key.encode(), n, values.ctypes.data)
        return values

    def string(self, key, default=None):
        if default is None:
            return call("CaseString", self._handle, key.encode()).decode()
        return call("CaseStringOr", self._handle, key.encode(), default.encode()).decode()

    def file(self, key):
        """A path, resolved against the case file's folder."""
        return call("CaseFile", self._handle, key.encode()).decode()

    def finish(self, *sections):
        """Refuses keys of these sections that nobody has read; the last call."""
        if sections:
            call("CaseFinish", self._handle, words(sections))
        call("CaseClose", byref(self._handle))
