"""What is seen in each figure of designs."""

CAPTIONS = {
    "designs": (
        "Family {family}: what each design is and how robust, over what varies. Frequencies, largest loss of clearance as "
        "the tip swings along free modes, where interactions lie, speeds certainly and possibly above yield, largest stress."
    ),
}
