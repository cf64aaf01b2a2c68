# A study of one's own: the blades, scenes and speeds of config/, simulated by r37. Rules of yours may follow below.
from r37 import SNAKEFILE


module r37:
    snakefile:
        SNAKEFILE


use rule * from r37


# checks of what is asked for, one line on the progress, and last words
onstart:
    r37.onstart()


onsuccess:
    r37.onsuccess()


onerror:
    r37.onerror()
