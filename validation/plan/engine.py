"""Numbers that stand for the engine: what is behind it is made again when one of them moves."""

from evidence.plan import ENGINE, Item

EVIDENCE = [Item("evidence.engine_numbers.renew", {"numbers": ENGINE})]
