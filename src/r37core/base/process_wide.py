"""A setting of the whole process that several threads want for a while: the first one makes it, the last one takes it back."""

import threading
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, ExitStack, contextmanager


def one_thread() -> AbstractContextManager[object]:
    """A context in which the linear algebra library has one thread: several add in another order."""
    # before the limit, which holds for libraries that are loaded
    import scipy.linalg  # noqa: F401
    from threadpoolctl import threadpool_limits

    return threadpool_limits(1)


class ProcessWide:
    """The context that `make` gives, entered once for all threads that are within; called in a `with`, or as a decorator."""

    def __init__(self, make: Callable[[], AbstractContextManager[object]]):
        self._make, self._lock, self._within, self._stack = make, threading.Lock(), 0, ExitStack()

    @contextmanager
    def __call__(self) -> Iterator[None]:
        """Be within."""
        with self._lock:
            if not self._within:
                self._stack.enter_context(self._make())
            self._within += 1
        try:
            yield
        finally:
            with self._lock:
                self._within -= 1
                if not self._within:
                    self._stack.close()
