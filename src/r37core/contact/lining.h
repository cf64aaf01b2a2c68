/* The law of one bar of the abradable lining. */
#pragma once

#include "contact/vector.h"

/* Press a bar's surface to `penetration` (m) beyond its first position. Returns the stress (Pa); updates the wear (m).
 *
 * Trial stress E (penetration - wear)/thickness against the yield stress plus plastic modulus times plastic strain; beyond
 * it, plastic strain grows by the excess over E plus the plastic modulus (Simo and Hughes, Computational Inelasticity, box
 * 1.4). A bar cannot pull, and wear never shrinks nor passes the thickness. */
INLINE REAL return_mapping(REAL penetration, REAL *wear, REAL thickness, REAL elastic_modulus, REAL plastic_modulus,
                           REAL yield_stress)
{
    const REAL stiffness = elastic_modulus / thickness;
    const REAL trial = stiffness * (penetration - *wear);
    if (!(trial > 0))
        return 0;
    const REAL excess = trial - (yield_stress + plastic_modulus * *wear / thickness);
    if (!(excess > 0))
        return trial;
    const REAL worn = *wear + thickness * excess / (elastic_modulus + plastic_modulus);
    *wear = worn < thickness ? worn : thickness;
    const REAL stress = stiffness * (penetration - *wear);
    return stress > 0 ? stress : 0;
}
