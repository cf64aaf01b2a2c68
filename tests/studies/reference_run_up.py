"""Run-ups by each of the two engines."""

from reference_engine import ReferenceSimulation

from r37studies.run_up_integration import RunUpIntegration


class ReferenceRunUp(RunUpIntegration):
    """A run-up by the reference engine."""

    simulation_class = ReferenceSimulation


RUN_UPS = {"compiled": RunUpIntegration, "reference": ReferenceRunUp}
