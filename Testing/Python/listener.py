"""Messages of a VTK object."""

import re

from vtkmodules.util.misc import calldata_type
from vtkmodules.vtkCommonCore import VTK_STRING


def sentence_of(text):
    """Text of a message without its place in the source."""
    return re.sub(r"^(ERROR|Warning): In .*?\n.*?\): ", "", text, flags=re.S).strip()


class Listener:
    """Future messages of an object."""

    def __init__(self, thing):
        self.errors = []
        self.warnings = []

        @calldata_type(VTK_STRING)
        def on_error(caller, event, text):
            self.errors.append(text)

        @calldata_type(VTK_STRING)
        def on_warning(caller, event, text):
            self.warnings.append(text)

        self.observers = []
        self.observe(thing, "ErrorEvent", on_error)
        self.observe(thing, "WarningEvent", on_warning)
        if hasattr(thing, "GetExecutive"):
            # Errors of the executive add nothing, but would be printed.
            self.observe(thing.GetExecutive(), "ErrorEvent", lambda caller, event: None)

    def observe(self, thing, event, function):
        self.observers.append((thing, thing.AddObserver(event, function)))

    def stop(self):
        for thing, observer in self.observers:
            thing.RemoveObserver(observer)

    def forget(self):
        self.errors.clear()
        self.warnings.clear()
