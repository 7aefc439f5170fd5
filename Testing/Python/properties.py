"""Properties of the wrapped classes, by reflection, so that none is forgotten."""

import re

PACKAGE = "active_implicit_surfaces"


def own_properties(kind):
    """Names X of the methods SetX(value) of a class and its own superclasses, without those of
    VTK."""
    ours = [base for base in kind.__mro__ if base.__module__.startswith(PACKAGE)]
    setters = {name for base in ours for name in vars(base) if name.startswith("Set")}
    return sorted(name[3:] for name in setters if takes_a_value(getattr(kind, name)))


def takes_a_value(setter):
    """Returns true unless the method is a SetXToSomething()."""
    return re.match(r"Set\w+\(self\)", setter.__doc__) is None


def comment_of(kind, name):
    """The property's comment, without the signature lines that the wrapper puts above it."""
    signatures, _, comment = getattr(kind, "Set" + name).__doc__.rpartition("\nC++: ")
    return comment.partition("\n\n")[2] if signatures else comment


def get(thing, name):
    return getattr(thing, "Get" + name)()


def put(thing, name, value):
    getattr(thing, "Set" + name)(value)
