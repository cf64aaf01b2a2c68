"""Number of calls that a function makes: cost that no other load of the machine changes."""

import sys


def calls_of(function, *arguments):
    """Calls of Python and built-in functions, and steps of generators, until `function` returns or raises."""
    count, before = 0, sys.getprofile()

    def counted(frame, event, value):
        nonlocal count
        count += event in ("call", "c_call")

    sys.setprofile(counted)
    try:
        function(*arguments)
    except ValueError:
        pass
    finally:
        sys.setprofile(before)
    return count
