"""Columns that second motions add to ranking.csv. Light: the workflow imports it."""

from r37core.results.columns import Column

WORST_MOTION = (
    Column("length_most_revolutions_rest_rad_s", "length above yield in most revolutions from rest, at the speeds of sweeps"),
    Column(
        "length_most_revolutions_worst_rad_s",
        "length above yield in most revolutions by the worst motion up, down and from rest, or from rest alone if longer",
    ),
    Column("largest_rms_worst_m", "largest rms of the motions up, down and from rest"),
    Column("carried_revolutions", "revolutions of the motions up and down at each speed, by default those from rest"),
    Column("rank_worst", "place by the worst motion"),
)
