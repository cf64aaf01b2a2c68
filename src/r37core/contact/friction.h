/* Direction of Coulomb friction. */
#pragma once

#include "contact/vector.h"

struct direction {
    vector tangential, axial;
};

/* Unit vectors of the friction forces on nodes, opposite to their sliding velocities (m/s): those of the rotation, signed,
 * plus those of the vibration. Zero where nothing slides. */
INLINE struct direction friction_direction(vector rotation, vector tangential, vector axial)
{
    const vector along = rotation + tangential;
    const vector size = square_root(along * along + axial * axial);
    const vector opposite = choose(size > 0, -1 / size, (vector){0});
    return (struct direction){along * opposite, axial * opposite};
}
