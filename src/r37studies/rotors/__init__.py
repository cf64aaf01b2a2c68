"""Whole rotors on one lining: numbers of each blade over speed, who leads, and waves that run round the rotor."""
