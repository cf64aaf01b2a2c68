"""A blade that starts in motion, in the coordinates of its reduced model."""

from dataclasses import dataclass

import numpy as np

from r37core.time_integration.integrators import increments


@dataclass
class MotionAtStart:
    """Displacement and velocity of the reduced model's coordinates, as a run starts; it is put as a carried motion is."""

    displacement: object = None
    velocity: object = None

    def put(self, problem, state):
        """The increment u_0 - u_{-1} is that of free motion; with central differences the velocity is (u_1 - u_{-1})/(2h)."""
        model, size = problem.model, len(problem.model.to_reduced)
        given = [np.zeros(size) if part is None else np.asarray(part) for part in (self.displacement, self.velocity)]
        displacement, velocity = np.linalg.lstsq(model.to_reduced, np.transpose(given), rcond=None)[0].T @ problem.blade.modes
        own = problem.blade.frequencies
        damping, step = problem.scene.damping(own, problem.speed), problem.grid.time_step
        factors = increments(problem.choice.integrator, own, damping, step)
        problem.contact.put_followers(displacement, velocity)
        increment = factors.displacement_factor * displacement + factors.velocity_factor * velocity
        if problem.contact.quadratic is not None:
            # forces kick at an instant, and the velocity is that in the middle of the kick
            stepping = problem.blade.recursion
            increment -= stepping.inverse * problem.contact.quadratic.force(displacement) / (1.0 + stepping.keep)
        stepped = slice(len(own))
        state.displacement[stepped], state.increment[stepped] = displacement, increment
