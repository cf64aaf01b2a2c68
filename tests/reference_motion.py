"""Motions of a blade as the reference engine steps them, with dense matrices: freely, and with a force in a step.

A motion is read from a state and written back into it; what it is in numbers is each class's own. All give the `numbers` of a
snapshot, the motion `flown` one step on without force and that with what a force adds at the end of a step (`pushed`), the
`displacement` of the modes at rest and what it `slid` in the last step, and `work_and_loss` of a step under a force.
`response`: displacement of the modes at rest one step on per force on them. `products`: how many of second order come behind
the modes at rest, in displacements and forces.
"""

from dataclasses import replace

import numpy as np

from r37core.rom.quadratic_terms import products_of


class RealMotion:
    """Modes without coupling, in u_n and d_n = u_n - u_{n-1} of the modes at rest.

    A + B rounds to 1 - 1e-9 of omega^2 away, so the recursion is carried in these.
    """

    products = 0

    def __init__(self, modes, recursion):
        self._modes, recursion = modes, recursion[: modes.shape[1]]
        # -B, I - A - B, C and the loss per squared central difference, as matrices
        self._keep, self._pull, self.response, self._loss = (
            modes @ np.diag(diagonal) @ modes.T
            for diagonal in (recursion.keep, recursion.pull, recursion.inverse, recursion.loss)
        )

    def read(self, state):
        return np.array([state.displacement, state.increment]) @ self._modes.T

    def write(self, motion, state):
        state.displacement[:], state.increment[:] = motion @ self._modes

    def numbers(self, motion):
        return motion[0] @ self._modes

    def flown(self, motion):
        u, d = motion
        following = self._keep @ d - self._pull @ u
        return np.array([u + following, following])

    def pushed(self, motion, force):
        return motion + self.response @ force

    def displacement(self, motion):
        return motion[0]

    def slid(self, motion):
        return motion[1]

    def work_and_loss(self, before, after, force):
        moved = before[1] + after[1]
        return float(0.5 * force @ moved), float(moved @ self._loss @ moved)


class QuadraticMotionOfModes(RealMotion):
    """Modes with displacements of second order, as r37core.time_integration.quadratic_motion has them, written out.

    Followers come behind the modes at rest in a motion; displacements and forces have the products there.
    """

    def __init__(self, problem, recursion):
        self._quadratic, self._rest = problem.contact.quadratic, len(problem.blade.modes)
        followers = problem.blade.followers.shape[1]
        modes = np.pad(problem.blade.modes, ((0, followers), (0, 0)))
        modes[self._rest :, modes.shape[1] - followers :] = np.eye(followers)
        super().__init__(modes, recursion)
        self.products, self._inverse = len(self._quadratic.weights), self.response
        self.response = np.zeros((self._rest + self.products,) * 2)
        self.response[: self._rest, : self._rest] = self._inverse[: self._rest, : self._rest]
        rows = self._quadratic.rows @ self._modes.T
        self._coordinates, self._changes = np.split(rows, [len(rows) - self.products])

    def _gradient(self, u):
        """Change of the products per displacement of the modes at rest and followers, shape (products, both)."""
        q, (a, b) = self._coordinates @ u, self._quadratic.pairs
        return q[a, None] * self._coordinates[b] + q[b, None] * self._coordinates[a]

    def _elastic_force(self, u):
        """Minus the gradient of the energy of second order."""
        quadratic = self._quadratic
        products, changes = self._products(u), self._changes @ u
        # of w r (s/2 + c r/4) with symmetric w c
        counted = quadratic.reduction(quadratic.energy_left(products))
        stiffness = quadratic.weights * 0.5 * (changes + quadratic.cubic @ products + counted * (quadratic.left @ products))
        return -self._gradient(u).T @ stiffness - 0.5 * self._changes.T @ (quadratic.weights * products)

    def _products(self, u):
        return products_of(self._coordinates @ u)

    def numbers(self, motion):
        return np.append(super().numbers(motion), self._products(motion[0]))

    def pushed(self, motion, force):
        # the elastic forces act from the begin of the step on
        before = motion[0] - motion[1]
        return motion + self._inverse @ (self._modal_force(before, force) + self._elastic_force(before))

    def _modal_force(self, u, force):
        """A force on modes at rest and products as one on modes at rest and followers, at a displacement u."""
        pushed_modes = self._gradient(u).T @ force[self._rest :]
        pushed_modes[: self._rest] += force[: self._rest]
        return pushed_modes

    def displacement(self, motion):
        return np.append(motion[0][: self._rest], self._products(motion[0]))

    def slid(self, motion):
        changed = self._products(motion[0]) - self._products(motion[0] - motion[1])
        return np.append(motion[1][: self._rest], changed)

    def work_and_loss(self, before, after, force):
        return super().work_and_loss(before, after, self._modal_force(before[0], force))


class MotionWithCasing:
    """A blade's motion, and beside it that of an elastic casing: u and d of its modes in the frame that does not turn.

    A motion is that of the blade, that of the casing, shape (2, casing modes), and the step it is at. Displacements and forces
    are those of the modes at rest, then of the casing's.

    `counted`: whether work and loss of the casing's modes are; of several blades in one casing those of one blade are.
    """

    counted = True

    def __init__(self, blade, problem, recursion):
        self._blade, self._problem, self._ring = blade, problem, problem.casing.ring
        self._stepped = len(problem.blade.frequencies)
        self._casing = recursion[self._stepped :]
        # and products
        rest_modes = len(problem.blade.modes) + blade.products
        self.response = np.zeros((rest_modes + len(self._casing.keep),) * 2)
        self.response[:rest_modes, :rest_modes] = blade.response
        self.response[rest_modes:, rest_modes:] = np.diag(self._casing.inverse)
        self._rest_modes = rest_modes

    def pressed_by_all(self, forces):
        """Forces of several blades in one casing: on its modes the sum over blades, which each of them has then."""
        casing_force = np.sum([force[self._rest_modes :] for force in forces], axis=0)
        return [np.append(force[: self._rest_modes], casing_force) for force in forces]

    def _blade_state(self, state):
        """The state of the blade's modes alone: what is written into it is written into the whole."""
        return replace(state, displacement=state.displacement[: self._stepped], increment=state.increment[: self._stepped])

    def _turned(self, casing, step):
        return turned(self._ring, casing, 2.0 * np.pi * step / self._problem.grid.steps_per_revolution)

    def read(self, state):
        step = state.samples * self._problem.grid.steps_per_sample
        both = np.array([state.displacement[self._stepped :], state.increment[self._stepped :]])
        return self._blade.read(self._blade_state(state)), self._turned(both, -step), step

    def write(self, motion, state):
        self._blade.write(motion[0], self._blade_state(state))
        state.displacement[self._stepped :], state.increment[self._stepped :] = self._turned(*motion[1:])

    def numbers(self, motion):
        numbers, casing = self._blade.numbers(motion[0]), self._turned(*motion[1:])
        blade, products = np.split(numbers, [len(numbers) - self._blade.products])
        parts = np.split(blade, range(self._stepped, len(blade), self._stepped))
        return np.concatenate([*(np.concatenate(pair) for pair in zip(parts, casing, strict=False)), products])

    def flown(self, motion):
        blade, (u, d), step = motion
        following = self._casing.keep * d - self._casing.pull * u
        return self._blade.flown(blade), np.array([u + following, following]), step + 1

    def pushed(self, motion, force):
        blade, casing, step = motion
        pushed = casing + self._casing.inverse * force[self._rest_modes :]
        return self._blade.pushed(blade, force[: self._rest_modes]), pushed, step

    def displacement(self, motion):
        return np.concatenate([self._blade.displacement(motion[0]), motion[1][0]])

    def slid(self, motion):
        return np.concatenate([self._blade.slid(motion[0]), motion[1][1]])

    def work_and_loss(self, before, after, force):
        work, loss = self._blade.work_and_loss(before[0], after[0], force[: self._rest_modes])
        if not self.counted:
            return work, loss
        own, casing_force = self._casing, force[self._rest_modes :]
        moved = before[1][1] + after[1][1]
        return work + float(0.5 * casing_force @ moved), loss + float(own.loss @ moved**2)


def motion_of(problem, recursion):
    """Motion of a problem's blade, and of its elastic casing."""
    if problem.contact.quadratic is not None:
        blade = QuadraticMotionOfModes(problem, recursion)
    else:
        blade = RealMotion(problem.blade.modes, recursion)
    return blade if problem.casing.ring is None else MotionWithCasing(blade, problem, recursion)


def turned(ring, coordinates, angle):
    """Coordinates of a casing's modes in a frame turned by `angle` (rad) towards negative theta, shape (..., 2 modes)."""
    cosine, sine = (function(angle * ring.nodal_diameters) for function in (np.cos, np.sin))
    first, second = np.split(coordinates, 2, axis=-1)
    return np.concatenate([cosine * first - sine * second, sine * first + cosine * second], axis=-1)
