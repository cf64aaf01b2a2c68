"""What is seen in each figure of time signals."""

CAPTIONS = {
    "spectrogram": (
        "Blade {blade} in scene {scene}: engine orders of the leading edge's motion and of strain gauges over the revolutions "
        "since the start, at each speed; Hann windows of eight revolutions."
    ),
    "orders": (
        "Blade {blade} in scene {scene}: amplitude of the strongest whole engine orders over the revolutions since the "
        "start, at each speed. Beside them, where there are probes: the leading edge's displacement that tip timing tells."
    ),
}
