"""What makes each table and picture of README and docs/, whether it is older than that, and making it again.

`make claims` lists what is older and makes it again; `make claims ONLY=growth.png` one table, picture or group of them. A claim
is up to date when the hash that its file carries is the present one (hashes.py). registry.py has them all, docs/older.json
those that are known to be older, with the reason that stands beside them on their pages.
"""
